#pragma once

#include <functional>
#include <string_view>

#include "io/ranks/rank_session.h"

namespace menger::io {

/// Runs the body of a program whose first rank gives tasks to the others, as run_program does. Only the first rank prints, and
/// only its exit code counts; it is told what another one threw. A program that nobody started as a rank is the first and only
/// one.
/// @param body of every rank
int run_rank_program(std::string_view name, const std::function<int(RankSession& session)>& body);

}  // namespace menger::io
