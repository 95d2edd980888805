#include <samara/section/recovery.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** The factor 1/R of a load R at which a R² + b R = 1, a ≥ 0 but for round-off; zero if there is none. */
    double
    inverse_factor(const double a, const double b)
    {
      // 1/R = x solves x² − b x − a = 0; the larger root is the first failure
      const double root = b * b + 4 * a;
      return root < 0 ? 0 : std::max(0., 0.5 * (b + std::sqrt(root)));
    }



    double
    max_stress_index(const Strengths &s, const Vector6 &stress)
    {
      double     index  = -1;
      const auto update = [&](const double value, const double strength) {
        if (strength > 0)
          index = std::max(index, value / strength);
      };
      for (int i = 0; i < 3; ++i)
        {
          update(std::max(stress(i), 0.), s.tensile(i));
          update(std::max(-stress(i), 0.), s.compressive(i));
        }
      for (int i = 0; i < 3; ++i) // 12, 13, 23 are the last in Voigt's order, backwards
        update(std::abs(stress(5 - i)), s.shear(i));
      return index;
    }



    double
    tsai_wu_index(const Strengths &s, const Vector6 &stress)
    {
      Vector3 linear, square;
      for (int i = 0; i < 3; ++i)
        {
          linear(i) = 1 / s.tensile(i) - 1 / s.compressive(i);
          square(i) = 1 / (s.tensile(i) * s.compressive(i));
        }
      double a = 0, b = 0;
      for (int i = 0; i < 3; ++i)
        {
          const int j = (i + 1) % 3;
          a += square(i) * stress(i) * stress(i) - std::sqrt(square(i) * square(j)) * stress(i) * stress(j) +
               std::pow(stress(5 - i) / s.shear(i), 2);
          b += linear(i) * stress(i);
        }
      return inverse_factor(a, b);
    }



    double
    hashin_index(const Strengths &s, const Vector6 &stress)
    {
      const double axial = s.shear(0), across = s.shear(2);
      const double along_fibres = (std::pow(stress(5), 2) + std::pow(stress(4), 2)) / (axial * axial),
                   sum          = stress(1) + stress(2),
                   in_matrix    = (std::pow(stress(3), 2) - stress(1) * stress(2)) / (across * across) + along_fibres;
      const double fibre        = stress(0) >= 0 ? std::sqrt(std::pow(stress(0) / s.tensile(0), 2) + along_fibres) :
                                                   -stress(0) / s.compressive(0);
      const double matrix =
        sum >= 0 ? inverse_factor(std::pow(sum / s.tensile(1), 2) + in_matrix, 0) :
                   inverse_factor(std::pow(sum / (2 * across), 2) + in_matrix,
                                  (std::pow(s.compressive(1) / (2 * across), 2) - 1) * sum / s.compressive(1));
      return std::max(fibre, matrix);
    }
  } // namespace



  double
  FailureIndices::largest() const
  {
    return std::max({max_stress, tsai_wu, hashin, von_mises});
  }



  double
  von_mises_stress(const Vector6 &s)
  {
    return std::sqrt(0.5 * (std::pow(s(0) - s(1), 2) + std::pow(s(1) - s(2), 2) + std::pow(s(2) - s(0), 2)) +
                     3 * s.tail<3>().squaredNorm());
  }



  FailureIndices
  failure_indices(const Strengths &s, const Vector6 &stress)
  {
    const bool     knows_all = s.tensile.minCoeff() > 0 && s.compressive.minCoeff() > 0 && s.shear.minCoeff() > 0;
    FailureIndices result;
    result.max_stress = max_stress_index(s, stress);
    if (knows_all)
      {
        result.tsai_wu = tsai_wu_index(s, stress);
        result.hashin  = hashin_index(s, stress);
      }
    if (s.yield > 0)
      result.von_mises = von_mises_stress(stress) / s.yield;
    return result;
  }



  SectionStresses::SectionStresses(const CrossSection                 &section,
                                   const SectionMesh                  &mesh,
                                   const std::vector<SectionMaterial> &materials)
  {
    for (const auto &material : materials)
      strengths.push_back(material.strengths);
    for (const auto &point : section.points_with_faces())
      points.push_back({elasticity::turn_of_stress(point.axes.transpose()) * point.C * point.strain,
                        elasticity::turn_of_stress(point.axes.transpose()).col(0) * point.helix,
                        mesh.ply(point.cell).material});
  }



  void
  SectionStresses::Extremes::add(const Strengths &of_material, const Vector6 &there)
  {
    add({there, samara::von_mises_stress(there), failure_indices(of_material, there)});
  }



  void
  SectionStresses::Extremes::add(const Extremes &others)
  {
    for (int i = 0; i < 6; ++i)
      if (std::abs(others.stress(i)) > std::abs(stress(i)))
        stress(i) = others.stress(i);
    von_mises_stress   = std::max(von_mises_stress, others.von_mises_stress);
    indices.max_stress = std::max(indices.max_stress, others.indices.max_stress);
    indices.tsai_wu    = std::max(indices.tsai_wu, others.indices.tsai_wu);
    indices.hashin     = std::max(indices.hashin, others.indices.hashin);
    indices.von_mises  = std::max(indices.von_mises, others.indices.von_mises);
  }



  SectionStresses::Extremes
  mean_of(const std::vector<std::pair<double, SectionStresses::Extremes>> &weighted)
  {
    SectionStresses::Extremes result;
    for (int i = 0; i < 6; ++i)
      {
        double modulus = 0, most = 0;
        for (const auto &[weight, one] : weighted)
          {
            const double part = weight * one.stress(i);
            modulus += std::abs(part);
            if (std::abs(part) > std::abs(most))
              most = part;
          }
        result.stress(i) = std::copysign(modulus, most);
      }
    FailureIndices &indices = result.indices;
    const auto      mean    = [&](const auto &index_of) {
      double sum = 0;
      for (const auto &[weight, one] : weighted)
        {
          if (index_of(one.indices) < 0)
            return -1.;
          sum += weight * index_of(one.indices);
        }
      return sum;
    };
    for (const auto &[weight, one] : weighted)
      result.von_mises_stress += weight * one.von_mises_stress;
    indices.max_stress = mean([](const FailureIndices &i) { return i.max_stress; });
    indices.tsai_wu    = mean([](const FailureIndices &i) { return i.tsai_wu; });
    indices.hashin     = mean([](const FailureIndices &i) { return i.hashin; });
    indices.von_mises  = mean([](const FailureIndices &i) { return i.von_mises; });
    return result;
  }



  SectionStresses::Extremes
  SectionStresses::extremes(const Vector6 &forces, const double helix) const
  {
    Extremes result;
    for (const Point &point : points)
      result.add(strengths[point.material], point.stress * forces + point.helix * helix);
    return result;
  }
} // namespace samara
