#pragma once

#include <string>
#include <vector>

namespace menger::fem {

/// A result of the program beside its reference. Each check prints a row of a Markdown table:
/// | what | computed | reference | relative error | tolerance | observed order |

/// Expects |computed - reference| <= tolerance |reference|.
void expect_close(const std::string& what, double computed, double reference, double tolerance);

/// Expects the errors of a family of meshes (or steps), each half as large as the one before, to fall with an order: that of the
/// last pair, log2 of the ratio of its errors, differs from `order` by at most `tolerance`.
/// @param values the results, coarsest first; the row names the finest
void expect_order(const std::string& what, const std::vector<double>& values, double reference, double order, double tolerance);

/// log2 of the ratio of two errors.
double observed_order(double coarse_error, double fine_error);

}  // namespace menger::fem
