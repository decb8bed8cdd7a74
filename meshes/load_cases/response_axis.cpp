#include "meshes/load_cases/response_axis.h"

#include "io/shown/shown_column.h"

namespace menger::meshes {

std::string response_axis_title(const std::vector<std::string>& columns) {
  const io::ShownColumn first = io::shown_column(columns.front());
  if (columns.size() == 1) return first.title();
  const std::string quantity = first.unit == "mm" ? "displacement" : first.unit == "Hz" ? "natural frequency" : "response";
  return io::ShownColumn{.name = {}, .quantity = quantity, .unit = first.unit}.title();
}

}  // namespace menger::meshes
