#ifndef samara_tests_stage_matrix_h
#define samara_tests_stage_matrix_h

#include "../scene.h"

#include <complex>
#include <random>

namespace samara
{
  /** M + hμ C + (hμ)² K with rows and columns of constraints as they are, about a state that is displaced and moves. */
  class StageMatrix
  {
  public:
    explicit StageMatrix(const std::string &source, const std::vector<std::string> &overrides = {})
      : scene(source, overrides)
      , pattern(scene.system.layout.pattern)
      , M(pattern)
      , C(pattern)
      , K(pattern)
    {
      State               state = scene.context.state;
      std::vector<double> z(scene.system.size());
      for (auto &value : z)
        value = 1e-3 * random();
      scene.system.update(state, z);
      for (unsigned int i = 6; i < state.y.size(); ++i)
        state.y[i] = random();
      scene.system.mass(M);
      scene.system.damping(state, C);
      scene.system.tangent(state, K);
    }

    template <typename Number>
    std::vector<Number>
    values(const Number hm) const
    {
      const int           n_kinematic = scene.system.layout.of_multiplier(0);
      std::vector<Number> result(pattern->n_nonzeros() + 1);
      for (int j = 0; j < pattern->size(); ++j)
        for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
          result[k] = j < n_kinematic && pattern->rows[k] < n_kinematic ?
                        M.values[k] + hm * (C.values[k] + hm * K.values[k]) :
                        K.values[k];
      return result;
    }

    template <typename Number>
    std::vector<Number>
    right_hand_side()
    {
      std::vector<Number> b(pattern->size());
      for (auto &value : b)
        if constexpr (std::is_same_v<Number, double>)
          value = random();
        else
          value = {random(), random()};
      return b;
    }

    double
    random()
    {
      return std::uniform_real_distribution<double>(-1, 1)(generator);
    }

    Scene                          scene;
    std::shared_ptr<const Pattern> pattern;
    SparseMatrix                   M, C, K;
    std::mt19937                   generator;
  };
} // namespace samara

#endif
