#include <samara/time/state_error.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** √(Σ P x²), x(i) of the state i of the group. */
    template <typename Values>
    double
    norm(const CountedStates &group, const Values &x)
    {
      double square = 0;
      for (unsigned int i = 0; i < group.states.size(); ++i)
        square += group.metric[i] * std::pow(x(i), 2);
      return std::sqrt(square);
    }
  } // namespace



  StateError::StateError(const System &system, const Tableau &tableau)
    : alpha(tableau.alpha)
    , order(2 * tableau.s)
    , phase(DissipationRelation(tableau).phase())
    , groups(counted_states(system.model))
    , scales(groups.size())
    , next(groups.size())
  {
    // what is smaller does not matter
    for (unsigned int g = 0; g < groups.size(); ++g)
      scales[g].largest =
        norm(groups[g], [&](const unsigned int i) { return system.model.states[groups[g].states[i]].scale; });
  }



  double
  StateError::of_step(const State &end, const std::vector<double> &difference, const double h)
  {
    double error = 0;
    if (!difference.empty())
      for (unsigned int g = 0; g < groups.size(); ++g)
        if (groups[g].weight > 0)
          error = std::max(error, groups[g].weight * advance(groups[g], end, difference, h, scales[g], next[g]));
    return error;
  }



  double
  StateError::advance(const CountedStates       &group,
                      const State               &end,
                      const std::vector<double> &difference,
                      const double               h,
                      const Scale               &from,
                      Scale                     &to) const
  {
    const double power = std::pow(h, order);
    to                 = from;
    to.step            = h;
    to.last.resize(group.states.size());
    for (unsigned int i = 0; i < to.last.size(); ++i)
      to.last[i] = difference[group.states[i]] / power;
    const double d       = norm(group, [&](const unsigned int i) { return to.last[i]; });
    const double change  = from.last.empty() ? d / h : norm(group, [&](const unsigned int i) {
      return (to.last[i] - from.last[i]) / (0.5 * (h + from.step));
    });
    const double keep    = from.tau > 0 ? std::exp(-h / (2 * from.tau)) : 0.;
    to.weight            = keep * from.weight + h;
    to.squares           = keep * from.squares + h * d * d;
    to.change_squares    = keep * from.change_squares + h * change * change;
    const double longest = 1e6 * h;
    to.tau = to.change_squares > 0 ? std::clamp(std::sqrt(to.squares / to.change_squares), h / 30, longest) : longest;
    to.largest = std::max(from.largest, norm(group, [&](const unsigned int i) { return end.states[group.states[i]]; }));
    if (!(to.largest > 0))
      return 0;
    return power * std::hypot(alpha, phase * h / to.tau) * std::max(d, std::sqrt(to.squares / to.weight)) / to.largest;
  }



  void
  StateError::accept()
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      if (!next[g].last.empty())
        std::swap(scales[g], next[g]);
  }



  std::vector<double>
  StateError::memory() const
  {
    std::vector<double> values;
    for (const Scale &scale : scales)
      {
        for (const double value :
             {scale.step, scale.weight, scale.squares, scale.change_squares, scale.tau, scale.largest})
          values.push_back(value);
        values.push_back(scale.last.size());
        values.insert(values.end(), scale.last.begin(), scale.last.end());
      }
    return values;
  }



  void
  StateError::set_memory(std::vector<double>::const_iterator from)
  {
    for (Scale &scale : scales)
      {
        for (double *const value :
             {&scale.step, &scale.weight, &scale.squares, &scale.change_squares, &scale.tau, &scale.largest})
          *value = *from++;
        const auto size = static_cast<std::ptrdiff_t>(*from++);
        scale.last.assign(from, from + size);
        from += size;
      }
  }
} // namespace samara
