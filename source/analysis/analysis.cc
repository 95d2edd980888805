#include <samara/analysis/analysis.h>
#include <samara/analysis/finite_matrix.h>
#include <samara/base/finite.h>
#include <samara/base/text.h>
#include <samara/model/doubts.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  std::vector<double>
  Context::speeds_at(const double speed) const
  {
    std::vector<double> result;
    const auto         &rotations = system.model.rotations;
    for (const auto &rotation : rotations)
      result.push_back(rotations[0].speed != 0. ? rotation.speed / rotations[0].speed * speed : speed);
    return result;
  }



  bool
  Context::is_shown() const
  {
    if (sweep.empty())
      return true;
    Assert(!system.model.rotations.empty(), dealii::ExcMessage("There are speeds, but nothing rotates."));
    const double nominal = system.model.rotations[0].speed;
    const bool   within  = std::find(sweep.begin(), sweep.end(), nominal) != sweep.end();
    return speeds[0] == (within ? nominal : sweep.back());
  }



  unsigned int
  n_swept(const std::vector<std::unique_ptr<Analysis>> &analyses)
  {
    const auto first =
      std::find_if(analyses.begin(), analyses.end(), [](const auto &a) { return a->is_of_one_speed(); });
    return first == analyses.begin() ? analyses.size() : first - analyses.begin();
  }



  void
  CoarseMeshes::check(const Context &context, const State &state, const std::string &when)
  {
    for (const auto &c : context.system.model.items)
      if (warned.count(c.get()) == 0)
        if (const std::string place = c->coarse_place(state); !place.empty())
          {
            context.log.warning(when, place + ". Results may be wrong: give it more <Elements>, or a higher <Degree>.");
            warned.insert(c.get());
          }
    for (const auto &c : context.system.model.items)
      if (const auto *const doubtful = dynamic_cast<const Doubtful *>(c.get()))
        {
          for (const auto &doubt : doubtful->doubts(state))
            if (doubted.emplace(c.get(), doubt.about).second)
              context.log.warning(when, doubt.text);
          const Doubtful::Energies now = doubtful->energies(state);
          Doubtful::Energies      &of  = largest[doubtful];
          of.left_out                  = std::max(of.left_out, now.left_out);
          of.elastic                   = std::max(of.elastic, now.elastic);
        }
  }



  void
  CoarseMeshes::conclude(const Context &context, const std::string &when)
  {
    for (const auto &c : context.system.model.items)
      if (const auto found = largest.find(dynamic_cast<const Doubtful *>(c.get())); found != largest.end())
        if (const std::string text = found->first->doubt_of_run(found->second);
            !text.empty() && doubted.emplace(c.get(), "of the run").second)
          context.log.warning(when, text);
  }



  void
  require_finite_state(const System &system, const State &state)
  {
    const Layout &layout = system.layout;
    const auto    check  = [&](const double number, const int unknown) {
      require_finite(number, [&]() { return layout.name_of(unknown); });
    };
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      for (unsigned int i = 0; i < 6; ++i)
        {
          check(state.q[12 * node + i % 3], layout.of_node(node) + i % 3);
          check(state.triad(node).col(i % 3).sum(), layout.of_node(node) + 3 + i % 3);
          check(state.y[6 * node + i], layout.of_node(node) + i);
        }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      check(state.coordinates[i], layout.of_coordinate(i));
    for (unsigned int i = 0; i < layout.n_states; ++i)
      check(state.states[i], layout.of_state(i));
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      check(state.multipliers[i], layout.of_multiplier(i));
    for (unsigned int i = 0; i < layout.n_strains; ++i)
      require_finite(state.stress[i], [&]() { return layout.item_of_strain(i).name + ", stresses"; });
  }



  void
  require_finite_matrix(const System &system, const SparseMatrix &A)
  {
    for (int j = 0; j < A.pattern->size(); ++j)
      for (int k = A.pattern->column_start[j]; k < A.pattern->column_start[j + 1]; ++k)
        require_finite(A.values[k], [&]() { return "the tangent matrix at " + system.layout.name_of(j); });
  }



  std::string
  Context::name_of_speed() const
  {
    constexpr unsigned int fewest = 6, most = 17; // short_text() has six; seventeen are all that a number has
    constexpr double       round_off = 1e-13;     // speeds are in proportion to that of the model
    const double           speed     = speeds[0];
    for (unsigned int digits = fewest;; ++digits)
      {
        const std::string format = "%." + std::to_string(digits) + "g", name = number_to_text(format.c_str(), speed);
        if (digits == most || std::none_of(sweep.begin(), sweep.end(), [&](const double other) {
              return std::abs(other - speed) > round_off * std::abs(speed) &&
                     number_to_text(format.c_str(), other) == name;
            }))
          return name;
      }
  }



  std::string
  short_text(const double number)
  {
    std::ostringstream text;
    text << number;
    return text.str();
  }
} // namespace samara
