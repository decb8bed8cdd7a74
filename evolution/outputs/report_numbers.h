#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/shown/shown_column.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// Returns a number as people read it: three digits, "0.0123" or "1.2e-05".
std::string shown_number(double value);
std::string shown_number(const std::optional<double>& value);  ///< a dash if there is none

/// Returns a number rounded to a whole one, 0 without a sign: "-7", "0".
std::string shown_whole(double value);

/// Returns a text in which numbers with more digits than people read are rounded to four: "0.01845" for "0.018449999999999998".
/// Only what stands alone and has seven digits or more after its point is a number here.
std::string with_rounded_numbers(const std::string& text);

/// Returns the number of a cell; nothing if the table has no such column, or if the cell is empty or no number.
std::optional<double> number_in(const io::CsvContents& table, std::size_t row, std::string_view column);

/// Returns the text of a cell; empty if the table has no such column.
std::string text_in(const io::CsvContents& table, std::size_t row, std::string_view column);

/// Returns a column of a table times a factor; what is no number is NaN, which a chart shows as a gap.
std::vector<double> column_of(const io::CsvContents& table, std::string_view column, double factor = 1.0);

/// Returns the progress of a walk in every row of its trajectory, m: the part of the horizontal displacement that lies along the
/// line from start to end; below 0 behind the start. What is no number is NaN.
/// @param direction horizontal, of length 1: that along which progress counts instead
std::vector<double> progress_of(const io::CsvContents& trajectory,
                                const std::optional<std::array<double, 2>>& direction = std::nullopt);

/// Returns the horizontal distance of the centre of mass from its start in every row of a trajectory, m. What is no number is
/// NaN.
std::vector<double> distance_from_start(const io::CsvContents& trajectory);

/// Returns the largest retreat of a progress: how far it comes back from the furthest that it has been before.
double largest_retreat(const std::vector<double>& progress);

/// Returns the middle of some numbers, the mean of the two middle ones of an even number; nothing if there are none.
std::optional<double> median_of(std::vector<double> values);

/// Returns the cell of a column as text for people: a number times the factor, or the text itself.
std::string shown_cell(const io::CsvContents& table, std::size_t row, const io::ShownColumn& column);

}  // namespace menger::evolution
