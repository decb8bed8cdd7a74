#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "evolution/evaluation/evaluator.h"

namespace menger::evolution {

/// Bodies that a rank evaluates together.
struct TaskMessage {
  std::size_t evaluator = 0;  ///< position among the evaluators that all ranks have
  std::vector<EvaluationTask> tasks;
};

/// Returns the bytes of a message: CBOR, with four cells of a body in a byte.
std::string bytes_of(const TaskMessage& message);

/// Does the reverse. @throws std::exception for bytes that are none of such a message
TaskMessage task_message_from(const std::string& bytes);

/// Returns the bytes of results. All numbers keep all their bits.
std::string bytes_of(std::span<const Evaluation> results);

/// Does the reverse. @throws std::exception for bytes that are none of results
std::vector<Evaluation> results_from(const std::string& bytes);

}  // namespace menger::evolution
