#include <samara/analysis/mode_families.h>

#include <samara/base/dense.h>

#include <Eigen/Eigenvalues>

namespace samara
{
  namespace
  {
    using Eigen::MatrixXcd;

    /** Of |λ|: what is nearer is equal. */
    constexpr double equal_modes = 1e-6;

    /** Of the energy of the parts: what moves them less has no pattern. */
    constexpr double least_energy_of_parts = 1e-9;



    /** Replace equal modes by combinations of them that are one pattern each, as far as there are such. */
    void
    separate_group(const ContentOfModes &contents,
                   std::vector<Mode>    &modes,
                   const std::size_t     first,
                   const std::size_t     n)
    {
      MatrixXcd shapes(modes[first].shape.size(), n);
      for (std::size_t i = 0; i < n; ++i)
        shapes.col(i) = modes[first + i].shape;
      const std::vector<MatrixXcd> energies = contents.energies_of_patterns(shapes);
      if (energies.empty())
        return;
      // of combinations the mean number of the pattern is stationary where it is one pattern alone
      MatrixXcd all = MatrixXcd::Zero(n, n), numbered = all;
      for (std::size_t m = 0; m < energies.size(); ++m)
        {
          all += energies[m];
          numbered += double(m) * energies[m];
        }
      if (symmetric_eigenvalues(all).minCoeff() <=
          least_energy_of_parts * all.trace().real())
        return;
      const HermitianEigen<std::complex<double>> solved = symmetric_eigen(numbered, all);
      if (!solved.was_found)
        return;
      const MatrixXcd turned = shapes * solved.vectors;
      for (std::size_t i = 0; i < n; ++i)
        modes[first + i].shape = turned.col(i).normalized();
    }
  } // namespace



  void
  separate_patterns(const System &system, const RepeatedParts &parts, const State &state, std::vector<Mode> &modes)
  {
    const std::vector<State> at_once(1, state);
    const ContentOfModes     contents(system, parts, at_once);
    for (std::size_t first = 0, end = 1; first < modes.size(); first = end++)
      {
        while (end < modes.size() &&
               std::abs(modes[end].lambda - modes[first].lambda) <= equal_modes * std::abs(modes[first].lambda))
          ++end;
        if (end - first > 1)
          separate_group(contents, modes, first, end - first);
      }
  }



  std::vector<ModeContent>
  contents_of(const System &system, const RepeatedParts &parts, const State &state, const std::vector<Mode> &modes)
  {
    const std::vector<State> at_once(1, state);
    const ContentOfModes     contents(system, parts, at_once);
    std::vector<ModeContent> result;
    for (const auto &mode : modes)
      result.push_back(contents.of({mode.shape}, mode.lambda.imag(), mode.left));
    return result;
  }
} // namespace samara
