#include "fem/space/rank_agreement.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace menger::fem {
namespace {

/// What comes out of an action, by its kind, and its message.
std::string outcome(const std::function<void()>& action) {
  try {
    on_first_rank(MPI_COMM_WORLD, action);
  } catch (const AgreedInputError& error) {
    return std::string("input: ") + error.what();
  } catch (const AgreedFault& error) {
    return std::string("fault: ") + error.what();
  }
  return "nothing";
}

TEST(RankAgreement, KeepsKindAndMessageOfEveryException) {
  EXPECT_EQ(outcome([] {}), "nothing");
  EXPECT_EQ(outcome([] { throw io::InputError("study.toml: path.first_step"); }), "input: study.toml: path.first_step");
  EXPECT_EQ(outcome([] { throw std::bad_alloc(); }), "input: not enough memory for this input");
  EXPECT_EQ(outcome([] { throw std::logic_error("a fault"); }), "fault: a fault");
  EXPECT_EQ(outcome([] { throw std::filesystem::filesystem_error("cannot", "folder", std::error_code()); }).substr(0, 6),
            "input:");
}

TEST(RankAgreement, MarksWhatAllRanksThrow) {
  EXPECT_THROW(on_every_rank(MPI_COMM_WORLD, [] { throw std::runtime_error("x"); }), Agreed);
  EXPECT_THROW(on_every_rank(MPI_COMM_WORLD, [] { throw io::InputError("x"); }), io::InputError);
}

}  // namespace
}  // namespace menger::fem
