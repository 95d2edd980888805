// How reactions of a joint press where it rubs: as one force, or at both ends of a guide.

#include <samara/joints/joint.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /** Of a joint in which axis 3 of B goes along that of A: the rows that hold its two tilts. */
    bool
    holds_tilt(const PairFunction &function)
    {
      return function.kind == PairFunction::cosine && function.i == 2;
    }
  } // namespace



  void
  Joint::add_bearing_length(Parameters &prm)
  {
    prm.add(
      "Bearing length",
      bearing_length,
      "Length of the guide on body B along axis 3 (of what slides on a beam along it), with the joint in its middle: forces at both of its ends, "
      "which also hold moments, press for its friction; 0: moments do not press [m].",
      dealii::Patterns::Double(0));
  }



  void
  Joint::check_bearing_length(Model &model) const
  {
    if (bearing_length > 0 &&
        std::none_of(free.begin(), free.end(), [](const FreeMotion &m) { return m.friction.is_given(); }))
      complain(model,
               "Bearing length",
               "joint <" + name + ">: a <Bearing length> is for friction, and there is none: give a <Friction>");
  }



  void
  Joint::add_pressing(std::vector<unsigned int> &multipliers) const
  {
    for (unsigned int i = 0; i < locked.size(); ++i)
      if (locked[i].function.kind == PairFunction::gap)
        multipliers.push_back(first_multiplier + i);
    for (unsigned int i = 0; i < locked.size() && bearing_length > 0; ++i)
      if (holds_tilt(locked[i].function))
        multipliers.push_back(first_multiplier + i);
  }



  bool
  Joint::presses(const Layout::Friction &friction) const
  {
    if (bearing_length == 0 || friction.multipliers.front() < first_multiplier)
      return false;
    std::vector<unsigned int> own;
    add_pressing(own);
    return own == friction.multipliers;
  }



  PressingParts<double>
  Joint::pressing_parts(const Layout::Friction &friction, const Point<double> &) const
  {
    PressingParts<double> parts;
    for (const double side : {-1., 1.})
      {
        auto &part = parts.add(friction.multipliers.size());
        for (unsigned int j = 0; j < friction.multipliers.size(); ++j)
          {
            const Locked &l = locked[friction.multipliers[j] - first_multiplier];
            if (l.function.kind == PairFunction::gap)
              part(l.axis, j) = 0.5 * l.sign;
            else if (l.axis == 1)
              part(0, j) = side * l.sign / bearing_length; // M × E₃ = (M₂, −M₁, 0)
            else
              part(1, j) = -side * l.sign / bearing_length;
          }
      }
    return parts;
  }



  PressingParts<std::complex<double>>
  Joint::pressing_parts(const Layout::Friction &friction, const Point<std::complex<double>> &) const
  {
    const auto                          real = pressing_parts(friction, Point<double>());
    PressingParts<std::complex<double>> parts;
    for (unsigned int p = 0; p < real.n; ++p)
      parts.add(friction.multipliers.size()) = real.of[p].cast<std::complex<double>>();
    return parts;
  }
} // namespace samara
