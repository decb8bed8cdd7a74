#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/ranks/rank_session.h"

namespace menger::io {

/// What a rank says of itself before the first task.
struct RankFacts {
  int threads = 1;      ///< with which it does tasks
  std::string machine;  ///< on which it runs
  std::string error;    ///< why it can do no task; empty if it can
  /// Texts that decide results, by what they are of, such as "physics". They must be the same on all ranks.
  std::map<std::string, std::string> deciding{};
};

/// Returns the facts of this rank. The program itself decides results, too: another build may give others.
RankFacts facts_of(const RankSession& session, int threads, std::map<std::string, std::string> deciding);

/// Tells the first rank the facts of this one.
void answer_roll(RankSession& session, const RankFacts& facts);

/// Waits for the facts of all ranks, and returns them by rank; none if Ctrl-C came before. To be called by the first rank.
/// @param own its facts
/// @param patience_s how long the others may take, > 0; they have a minute at least, since machines start at different times
/// @throws InputError naming the rank and its machine if one can do no task, would give other results than this one, ends, or
/// does not answer
std::vector<RankFacts> call_roll(RankSession& session, const RankFacts& own, double patience_s);

}  // namespace menger::io
