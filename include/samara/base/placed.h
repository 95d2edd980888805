#ifndef samara_base_placed_h
#define samara_base_placed_h

#include <samara/base/law.h>
#include <samara/base/placement.h>

#include <array>
#include <vector>

namespace samara
{
  /** Values of type T that have three components in space, and what they are when they are placed. */
  template <typename T>
  struct Placed
  {
    static constexpr bool is_spatial = false;
  };

  template <>
  struct Placed<Eigen::Vector3d>
  {
    static constexpr bool is_spatial = true;
    static Eigen::Vector3d of(const Eigen::Vector3d &value, const Placement &placement, bool is_position);
  };

  template <>
  struct Placed<std::vector<Eigen::Vector3d>>
  {
    static constexpr bool is_spatial = true;
    static std::vector<Eigen::Vector3d>
    of(const std::vector<Eigen::Vector3d> &value, const Placement &placement, bool is_position);
  };

  template <>
  struct Placed<std::array<Expression, 3>>
  {
    static constexpr bool is_spatial = true;
    static std::array<Expression, 3>
    of(const std::array<Expression, 3> &value, const Placement &placement, bool is_position);
  };

  template <>
  struct Placed<std::array<FunctionOfTime, 3>>
  {
    static constexpr bool is_spatial = true;
    static std::array<FunctionOfTime, 3>
    of(const std::array<FunctionOfTime, 3> &value, const Placement &placement, bool is_position);
  };

  template <>
  struct Placed<std::array<Law, 3>>
  {
    static constexpr bool is_spatial = true;
    static std::array<Law, 3> of(const std::array<Law, 3> &value, const Placement &placement, bool is_position);
  };
} // namespace samara

#endif
