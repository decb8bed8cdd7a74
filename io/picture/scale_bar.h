#pragma once

namespace menger::io {

/// Returns the length of a scale bar, which people read at a glance: the largest of 1, 2 and 5 times a power of ten that is at
/// most `longest`, > 0.
double scale_bar_length(double longest);

}  // namespace menger::io
