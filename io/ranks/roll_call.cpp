#include "io/ranks/roll_call.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "io/process/interrupt.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::io {

namespace {

using Clock = std::chrono::steady_clock;

/// A start of MPI, and of programs from a busy disk, takes so long at most, in s.
constexpr double longest_start_s = 60.0;

std::string bytes_of(const RankFacts& facts) {
  nlohmann::json deciding = nlohmann::json::object();
  for (const auto& [what, text] : facts.deciding) deciding[what] = content_hash(text);
  std::string bytes;
  nlohmann::json::to_cbor(
      {{"threads", facts.threads}, {"machine", facts.machine}, {"error", facts.error}, {"deciding", deciding}}, bytes);
  return bytes;
}

/// Returns facts whose deciding texts are hashes.
RankFacts facts_from(const std::string& bytes) {
  const nlohmann::json read = nlohmann::json::from_cbor(bytes);
  RankFacts facts{.threads = read.at("threads"), .machine = read.at("machine"), .error = read.at("error")};
  for (const auto& [what, hash] : read.at("deciding").items()) facts.deciding[what] = hash;
  return facts;
}

std::string name_of(int rank, const RankFacts& facts) { return "rank " + std::to_string(rank) + " on " + facts.machine; }

void require_same(int rank, const RankFacts& facts, const RankFacts& own) {
  if (!facts.error.empty()) throw InputError(name_of(rank, facts) + ": " + facts.error);
  for (const auto& [what, text] : own.deciding) {
    const auto found = facts.deciding.find(what);
    if (found != facts.deciding.end() && found->second == content_hash(text)) continue;
    throw InputError(name_of(rank, facts) + " has another " + what + " than rank 0 on " + own.machine +
                     ": their results would not be the same");
  }
}

}  // namespace

RankFacts facts_of(const RankSession& session, int threads, std::map<std::string, std::string> deciding) {
  // A process alone need not read its program.
  if (session.count() > 1) deciding["program"] = file_hash("/proc/self/exe");
  return {.threads = threads, .machine = RankSession::machine(), .error = {}, .deciding = std::move(deciding)};
}

void answer_roll(RankSession& session, const RankFacts& facts) { session.send(0, RankTopic::roll, bytes_of(facts)); }

std::vector<RankFacts> call_roll(RankSession& session, const RankFacts& own, double patience_s) {
  constexpr auto pause = std::chrono::milliseconds(1);
  const Clock::time_point start = Clock::now();
  const double longest_s = std::max(patience_s, longest_start_s);
  std::vector<std::optional<RankFacts>> answers(static_cast<std::size_t>(session.count()));
  answers.front() = own;
  std::size_t missing = answers.size() - 1;
  while (missing > 0) {
    if (const std::optional<RankMessage> message = session.receive()) {
      std::optional<RankFacts>& answer = answers.at(static_cast<std::size_t>(message->from));
      if (message->topic == RankTopic::ended && !answer)
        throw InputError("rank " + std::to_string(message->from) + " ended before its first task" +
                         (message->bytes.empty() ? "" : ": " + message->bytes));
      if (message->topic != RankTopic::roll) continue;
      if (!answer) --missing;
      answer = facts_from(message->bytes);
    } else if (interrupted()) {
      return {};
    } else if (std::chrono::duration<double>(Clock::now() - start).count() > longest_s) {
      std::size_t silent = 1;
      while (answers[silent]) ++silent;
      session.give_up(static_cast<int>(silent));
      throw InputError("rank " + std::to_string(silent) + " has not answered for " + number_text(longest_s) + " s");
    } else {
      std::this_thread::sleep_for(pause);
    }
  }
  std::vector<RankFacts> all;
  all.reserve(answers.size());
  for (std::optional<RankFacts>& one : answers) {
    if (!all.empty()) require_same(static_cast<int>(all.size()), *one, own);
    all.push_back(std::move(*one));
  }
  return all;
}

}  // namespace menger::io
