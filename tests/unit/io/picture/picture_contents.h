#pragma once

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "io/picture/chart.h"

namespace menger::io {

/// The pixels of a PNG picture.
class PictureContents {
 public:
  explicit PictureContents(const std::filesystem::path& file) {
    reader_->SetFileName(file.c_str());
    reader_->Update();
  }

  [[nodiscard]] int width() const { return reader_->GetOutput()->GetDimensions()[0]; }
  [[nodiscard]] int height() const { return reader_->GetOutput()->GetDimensions()[1]; }

  /// @param x, y from the lower left corner
  [[nodiscard]] bool has_colour(int x, int y, const Colour& colour) const {
    constexpr double tolerance = 6.0;  // of 255: averaging and rounding of the driver
    for (int part = 0; part < 3; ++part) {
      const double value = reader_->GetOutput()->GetScalarComponentAsDouble(x, y, 0, part);
      if (std::abs(value - colour.at(static_cast<std::size_t>(part))) > tolerance) return false;
    }
    return true;
  }

  /// Number of pixels of a colour in columns from `first` until before `last`.
  [[nodiscard]] int count(const Colour& colour, int first, int last) const {
    int pixels = 0;
    for (int x = first; x < last; ++x) {
      for (int y = 0; y < height(); ++y) pixels += has_colour(x, y, colour) ? 1 : 0;
    }
    return pixels;
  }
  [[nodiscard]] int count(const Colour& colour) const { return count(colour, 0, width()); }

 private:
  vtkNew<vtkPNGReader> reader_;
};

}  // namespace menger::io
