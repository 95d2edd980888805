#include <samara/analysis/integrating_states.h>

#include <samara/base/dense.h>

namespace samara
{
  std::vector<std::string>
  integrating_states(const System &system, const State &state)
  {
    const Layout          &layout = system.layout;
    const unsigned int     n = layout.n_states, first = layout.of_state(0);
    constexpr unsigned int most = 500;
    if (n == 0 || n > most)
      return {};
    SparseMatrix K(layout.pattern);
    system.tangent(state, K);
    Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(n, n);
    for (unsigned int j = 0; j < n; ++j)
      for (int k = layout.pattern->column_start[first + j]; k < layout.pattern->column_start[first + j + 1]; ++k)
        if (const int i = layout.pattern->rows[k] - static_cast<int>(first); i >= 0 && i < static_cast<int>(n))
          rates(i, j) = K.values[k];
    // states of different units: rows by their largest entries, then columns
    for (unsigned int i = 0; i < n; ++i)
      if (const double size = rates.row(i).cwiseAbs().maxCoeff(); size > 0)
        rates.row(i) /= size;
    // entries are of the size of one: what elimination leaves below is round-off
    const Eigen::MatrixXd kernel = FullLu(rates, 1e-10).kernel();
    if (kernel.cols() == 0)
      return {};
    std::vector<std::string> names;
    for (unsigned int i = 0; i < n; ++i)
      if (kernel.row(i).cwiseAbs().maxCoeff() > 1e-6 * kernel.cwiseAbs().maxCoeff())
        names.push_back(system.model.states[i].name);
    return names;
  }
} // namespace samara
