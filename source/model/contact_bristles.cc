// Bristles of pairs of a group of contacts: whose they are, and what they store.

#include <samara/model/contact_group.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /** Nearest places on lines are found again where they were, to this part of the radius. */
    constexpr double same_place = 1e-3;
  } // namespace



  PairBristle
  ContactGroup::bristle_of(const Pair &pair, const Vector3 &deflection) const
  {
    return {number,
            pair.bead,
            pair.other,
            kind_of(pair),
            pair.b_is_line ? pair.nearest.b.s : 0.,
            pair.a_is_line ? pair.nearest.a.s : 0.,
            deflection};
  }



  const PairBristle *
  ContactGroup::find_bristle(const Pair &pair, const PairBristles &bristles) const
  {
    const PairBristle  wanted  = bristle_of(pair, Vector3::Zero());
    const PairBristle *best    = nullptr;
    double             nearest = same_place * (pair.b_is_line ? lines[pair.bead].radius :
                                               pair.a_is_line ? lines[pair.other].radius :
                                                                1.);
    for (const PairBristle &b : bristles)
      if (b.group == number && b.kind == wanted.kind && b.bead == wanted.bead && b.other == wanted.other)
        if (const double away = std::abs(b.at_b - wanted.at_b) + std::abs(b.at_a - wanted.at_a); away <= nearest)
          {
            best    = &b;
            nearest = away;
          }
    return best;
  }



  double
  ContactGroup::energy_of(const PairBristle &bristle) const
  {
    if (bristle.group != number)
      return 0;
    Pair pair{
      bristle.bead, bristle.other, (bristle.kind & 1u) != 0, (bristle.kind & 2u) != 0, (bristle.kind & 4u) != 0};
    return 0.5 * share_of(pair) * bodies_of(pair).friction.bristle_stiffness * bristle.deflection.squaredNorm();
  }



  double
  ContactGroup::energy_of(const PairBristles &bristles) const
  {
    double sum = 0;
    for (const PairBristle &b : bristles)
      sum += energy_of(b);
    return sum;
  }
} // namespace samara
