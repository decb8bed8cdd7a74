#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <vector>
#include <xsimd/xsimd.hpp>

#include "fem/elements/element_kernel.h"
#include "fem/surfaces/face.h"

namespace menger::fem {

/// Position of a node of an element in the unit cube.
inline Point unit_node(int degree, std::size_t node) {
  const auto side = static_cast<std::size_t>(degree) + 1;
  const auto part = [degree](std::size_t step) { return static_cast<double>(step) / degree; };
  return {part(node % side), part(node / side % side), part(node / (side * side))};
}

/// Values per component of the nodes of an element, of a function of the position in the unit cube.
template <class Map>
std::vector<double> nodal_values(int degree, const Map& map) {
  std::vector<double> values;
  for (std::size_t a = 0; a < ElementShape{degree}.nodes(); ++a) {
    for (const double component : map(unit_node(degree, a))) values.push_back(component);
  }
  return values;
}

/// Reproducible numbers in [-amplitude, amplitude].
class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : generator_(seed) {}
  double operator()(double amplitude) {
    return amplitude * (2.0 * static_cast<double>(generator_()) / static_cast<double>(std::mt19937::max()) - 1.0);
  }
  std::vector<double> operator()(std::size_t count, double amplitude) {
    std::vector<double> values(count);
    for (double& value : values) value = (*this)(amplitude);
    return values;
  }

 private:
  std::mt19937 generator_;
};

/// An element: 3 numbers per node.
struct SampleElement {
  std::vector<double> positions;
  std::vector<double> displacements;
};

/// A bent element of about unit size with a strain of a few tenths that differs from point to point.
inline SampleElement strained_element(int degree, unsigned seed) {
  SampleElement element;
  element.positions = nodal_values(degree, [](const Point& x) {
    return Point{x[0] + 0.1 * x[1] * x[2], 1.1 * x[1] + 0.1 * x[0] * x[0] - 0.1 * x[2], 0.9 * x[2] + 0.1 * x[0] * x[1]};
  });
  RandomNumbers random(seed);
  std::array<double, 9> gradient{};
  for (double& component : gradient) component = random(0.15);
  for (std::size_t a = 0; a < element.positions.size(); a += 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      double u = random(0.03);
      for (std::size_t j = 0; j < 3; ++j) u += gradient[3 * i + j] * element.positions[a + j];
      element.displacements.push_back(u);
    }
  }
  return element;
}

/// What the kernels say of one element.
struct ElementResponse {
  double energy = 0.0;
  double smallest_ratio = 0.0;
  std::vector<double> residual;
  std::vector<double> stiffness;  ///< both triangles, row by row
};

struct PointResponse {
  std::vector<double> deformation_gradient;
  std::vector<double> cauchy_stress;
  std::vector<double> volume_ratio;
  std::vector<double> pressure;
};

/// Runs kernels on elements of one material, one per lane; the last one is repeated in lanes that are left.
class SampleBatch {
 public:
  using Packed = std::vector<double, xsimd::aligned_allocator<double, 64>>;

  SampleBatch(const ElementKernels& kernels, const ElementMaterial& material, const std::vector<SampleElement>& elements)
      : kernels_(kernels), material_(material), shape_{material.degree}, count_(elements.size()) {
    std::vector<std::vector<double>> positions;
    std::vector<std::vector<double>> displacements;
    for (const SampleElement& element : elements) {
      positions.push_back(element.positions);
      displacements.push_back(element.displacements);
    }
    positions_ = packed(positions);
    displacements_ = packed(displacements);
  }

  /// @param predicted_pressures per element; empty: the exact stiffness
  [[nodiscard]] std::vector<ElementResponse> evaluate(const std::vector<std::vector<double>>& predicted_pressures = {}) const {
    const Packed predicted = predicted_pressures.empty() ? Packed{} : packed(predicted_pressures);
    Packed residual = room(3 * shape_.nodes());
    Packed stiffness = room(9 * shape_.pairs());
    Packed energy = room(1);
    Packed ratio = room(1);
    kernels_.evaluate(material_, {.positions = positions_.data(),
                                  .displacements = displacements_.data(),
                                  .predicted_pressure = predicted.empty() ? nullptr : predicted.data(),
                                  .residual = residual.data(),
                                  .stiffness = stiffness.data(),
                                  .energy = energy.data(),
                                  .smallest_ratio = ratio.data()});
    std::vector<ElementResponse> responses;
    for (std::size_t lane = 0; lane < count_; ++lane) {
      responses.push_back({energy[lane], ratio[lane], unpacked(residual, lane), both_triangles(unpacked(stiffness, lane))});
    }
    return responses;
  }

  /// The same without residual and stiffness.
  [[nodiscard]] std::vector<ElementResponse> evaluate_energy() const {
    Packed energy = room(1);
    Packed ratio = room(1);
    kernels_.evaluate(material_, {.positions = positions_.data(),
                                  .displacements = displacements_.data(),
                                  .energy = energy.data(),
                                  .smallest_ratio = ratio.data()});
    std::vector<ElementResponse> responses;
    for (std::size_t lane = 0; lane < count_; ++lane) responses.push_back({energy[lane], ratio[lane], {}, {}});
    return responses;
  }

  [[nodiscard]] std::vector<std::vector<double>> predict_pressure(const std::vector<std::vector<double>>& steps) const {
    const Packed step = packed(steps);
    Packed predicted = room(shape_.points());
    kernels_.predict_pressure(material_, {.positions = positions_.data(), .displacements = displacements_.data()}, step.data(),
                              predicted.data());
    std::vector<std::vector<double>> responses;
    for (std::size_t lane = 0; lane < count_; ++lane) responses.push_back(unpacked(predicted, lane));
    return responses;
  }

  [[nodiscard]] std::vector<PointResponse> evaluate_points() const {
    Packed F = room(9 * shape_.points());
    Packed stress = room(9 * shape_.points());
    Packed ratio = room(shape_.points());
    Packed pressure = room(shape_.points());
    kernels_.evaluate_points(material_, {.positions = positions_.data(), .displacements = displacements_.data()},
                             {F.data(), stress.data(), ratio.data(), pressure.data()});
    std::vector<PointResponse> responses;
    for (std::size_t lane = 0; lane < count_; ++lane)
      responses.push_back({unpacked(F, lane), unpacked(stress, lane), unpacked(ratio, lane), unpacked(pressure, lane)});
    return responses;
  }

 private:
  [[nodiscard]] Packed room(std::size_t entries) const { return Packed(entries * kernels_.width, -7e77); }

  [[nodiscard]] Packed packed(const std::vector<std::vector<double>>& elements) const {
    Packed result(elements[0].size() * kernels_.width);
    for (std::size_t lane = 0; lane < kernels_.width; ++lane) {
      const std::vector<double>& element = elements[std::min(lane, elements.size() - 1)];
      for (std::size_t n = 0; n < element.size(); ++n) result[n * kernels_.width + lane] = element[n];
    }
    return result;
  }

  [[nodiscard]] std::vector<double> unpacked(const Packed& packed, std::size_t lane) const {
    std::vector<double> values(packed.size() / kernels_.width);
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = packed[n * kernels_.width + lane];
    return values;
  }

  [[nodiscard]] std::vector<double> both_triangles(const std::vector<double>& pairs) const {
    const std::size_t columns = 3 * shape_.nodes();
    std::vector<double> full(columns * columns);
    for (std::size_t a = 0; a < shape_.nodes(); ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        for (std::size_t n = 0; n < 9; ++n) {
          const double entry = pairs[9 * (a * (a + 1) / 2 + b) + n];
          full[(3 * a + n / 3) * columns + 3 * b + n % 3] = entry;
          if (a != b) full[(3 * b + n % 3) * columns + 3 * a + n / 3] = entry;
        }
      }
    }
    return full;
  }

  const ElementKernels& kernels_;
  const ElementMaterial& material_;
  ElementShape shape_;
  std::size_t count_;
  Packed positions_;
  Packed displacements_;
};

}  // namespace menger::fem
