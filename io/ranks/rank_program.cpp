#include "io/ranks/rank_program.h"

#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include "io/process/exit_code.h"
#include "io/process/interrupt.h"
#include "io/process/program.h"

namespace menger::io {

int run_rank_program(std::string_view name, const std::function<int(RankSession& session)>& body) {
  std::optional<RankSession> session;
  std::string fault;
  const int code = run_program(name, [&] {
    hold_interrupts();  // MPI cannot be interrupted while it starts
    session.emplace();
    catch_interrupts();
    if (!session->is_first()) {  // all ranks would print the same
      std::cout.setstate(std::ios::failbit);
      std::cerr.setstate(std::ios::failbit);
    }
    try {
      return body(*session);
    } catch (const std::exception& error) {
      fault = error.what();
      throw;
    }
  });
  if (!session) return code;
  session->end(code, fault);
  return session->is_first() ? code : exit_code::done;
}

}  // namespace menger::io
