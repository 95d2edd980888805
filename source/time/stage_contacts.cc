#include <samara/base/text.h>
#include <samara/time/stage_contacts.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  StageContacts::StageContacts(const System &system, const Tableau &tableau)
    : system(system)
    , tableau(tableau)
    , groups(system.layout.contact_groups.size())
    , change_of_energy(groups.size())
  {}



  void
  StageContacts::start(const State &state, const double h)
  {
    near.clear();
    bristles.clear();
    step    = h;
    q_start = state.q;
    for (unsigned int i = 0; i < groups.size(); ++i)
      {
        const ContactGroup &group = *system.layout.contact_groups[i];
        group.find_pairs(state.q.data(), state.y.data(), h, found, groups[i].margins);
        groups[i].energy = 0;
        for (const auto &pair : found)
          {
            group.find_sides(pair, state.q.data(), sides); // here it was found
            const PairMeasure<double> m(group.shape(pair), group.places<double>(pair, sides, state.q.data(), nullptr));
            near.push_back({&group, pair, m.gap, m.distance});
            if (group.bodies_of(pair).friction.has_bristles())
              start_bristles(state, near.back(), m);
            groups[i].energy += group.part_of(pair) * group.law_of(pair).energy(m.gap);
          }
      }
    find_lost_bristles(state);
  }



  void
  StageContacts::evaluate(const std::vector<Point<double>> &stages,
                          const double *const               end,
                          const double                      h,
                          const std::vector<double *>      &residuals,
                          const std::vector<double *>      &in_axes)
  {
    for (Near &pair : near)
      evaluate(pair, stages, end, h, residuals, in_axes);
  }



  namespace
  {
    /**
     * Nearest places move along lines, and axes of cylinders turn: h Σ b r misses g_f − g_i by O(h^(2s+1)), and forces
     * along the gradient miss U_f − U_i by U'_m times that. A force along the velocity of B against A does what is
     * missing. Its factor [N s/m], of a pair whose part is one; zero, so that the step is refused, if it were more than
     * a hundredth of the force that presses.
     */
    double
    factor_of_missing_work(const ContactGroup                     &group,
                           const ContactGroup::Pair               &pair,
                           const Tableau                          &tableau,
                           const StepGaps                         &gaps,
                           const std::vector<PairMeasure<double>> &measures,
                           const double                            h,
                           StopForces                             &forces)
    {
      constexpr double part_of_force = 0.01, round_off = 1e-14;
      if (!pair.a_is_line && group.shape(pair).kind != PairShape::cylinder)
        return 0; // φ is quadratic: the work is exact to round-off
      const double mean    = group.law_of(pair).mean(gaps.start, gaps.end).force,
                   missing = gaps.end - gaps.start - gaps.change;
      double squares = 0, fastest = 0;
      for (unsigned int k = 0; k < tableau.s; ++k)
        {
          const double speed = measures[k].whole.norm();
          squares += tableau.b(k) * speed * speed;
          fastest = std::max(fastest, speed);
        }
      // what rests against the other misses round-off alone, and has no velocity that could do it
      if (std::abs(missing) < round_off * measures[0].distance)
        return 0;
      if (mean == 0 || !(std::abs(missing) * fastest < part_of_force * h * squares))
        return 0;
      forces.elastic += mean * missing;
      forces.work_defect = std::abs(forces.work_defect) + std::abs(mean * missing);
      return mean * missing / (h * squares);
    }

    /**
     * Places of stages that turn are as much too near as their triads are too short: there φ is integrated from its
     * rates, as strains are, and constant in steady rotation.
     */
    void
    integrate_gaps(const PairShape                        &shape,
                   const Tableau                          &tableau,
                   const double                            phi_at_start,
                   const double                            h,
                   const std::vector<PairMeasure<double>> &measures,
                   std::array<double, 3>                  &gaps)
    {
      for (unsigned int k = 0; k < tableau.s; ++k)
        {
          double phi = phi_at_start;
          for (unsigned int l = 0; l < tableau.s; ++l)
            phi += h * tableau.a(k, l) * measures[l].rate;
          gaps[k] = shape.gap_at(phi);
        }
    }
  } // namespace



  void
  StageContacts::evaluate(Near                             &n,
                          const std::vector<Point<double>> &stages,
                          const double *const               end,
                          const double                      h,
                          const std::vector<double *>      &residuals,
                          const std::vector<double *>      &in_axes)
  {
    const ContactGroup &group = *n.group;
    const PairShape     shape = group.shape(n.pair);
    n.is_touched              = false;
    n.friction_loss           = 0;
    n.is_lost                 = !group.find_sides(n.pair, end, sides);
    if (n.bristles >= 0)
      straighten(n);
    if (n.is_lost)
      return;
    const PairMeasure<double> at_end(shape, group.places<double>(n.pair, sides, end, nullptr));
    const double              scale = shape.sign() / (0.5 * (n.distance + at_end.distance));
    std::array<double, 3>     gaps{}, rates{};
    // with places alone most pairs are found not to touch
    n.is_touched = n.gap > 0 || at_end.gap > 0;
    for (unsigned int k = 0; k < tableau.s && !n.is_touched; ++k)
      n.is_touched = !(group.gap(n.pair, stages[k].q) <= 0);
    if (!n.is_touched)
      return;
    std::vector<PairMeasure<double>> &measures = measures_of_stages;
    measures.clear();
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        n.is_lost    = !group.find_sides(n.pair, stages[k].q, sides_of_stages[k]) || sides_of_stages[k].is_parallel;
        n.is_touched = !n.is_lost;
        if (n.is_lost)
          return;
        measures.emplace_back(shape,
                              group.places(n.pair, sides_of_stages[k], stages[k].q, stages[k].y, stages[k].reciprocal));
        gaps[k]  = measures[k].gap;
        rates[k] = scale * measures[k].rate;
      }
    if (stages[0].reciprocal != nullptr)
      integrate_gaps(shape, tableau, shape.phi_at(n.gap), h, measures, gaps);
    const StepGaps in_step(tableau, n.gap, gaps.data(), at_end.gap, rates.data(), h);
    n.forces               = contact_forces(group.law_of(n.pair), tableau, in_step, rates.data(), h);
    const double part      = group.part_of(n.pair),
                 along_way = part * factor_of_missing_work(group, n.pair, tableau, in_step, measures, h, n.forces);
    const PairLaw              &of_bodies = group.bodies_of(n.pair);
    std::array<Vec3<double>, 3> of_bristles;
    if (n.bristles >= 0)
      rub(n, stages, end, at_end, h, of_bristles);
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        const PairMeasure<double> &m = measures[k];
        const double               f = part * n.forces.force[k];
        PairDampers<double>        dampers;
        if (of_bodies.has_friction && f > 0)
          dampers = PairDampers<double>(m, shape, of_bodies, f, n.bristles < 0);
        n.friction_loss += h * tableau.b(k) * dampers.power(m);
        ContactForces<double> forces(m, f * scale, dampers);
        if (n.bristles >= 0)
          forces.add_rub(m, of_bristles[k]);
        if (along_way != 0)
          forces.add_rub(m, along_way * m.whole);
        const auto of_node = [&](const unsigned int node) { return system.layout.of_node(node); };
        group.add_forces(n.pair, sides_of_stages[k], forces, stages[k].q_of_forces(), of_node, residuals[k]);
        if (!in_axes.empty())
          group.add_forces(n.pair, sides_of_stages[k], forces, stages[k].q, of_node, in_axes[k]);
      }
  }



  std::string
  StageContacts::moved_too_far(const std::vector<Point<double>> &stages, const double *const end) const
  {
    std::vector<const double *> places(1, end);
    for (const auto &stage : stages)
      places.push_back(stage.q);
    for (unsigned int i = 0; i < groups.size(); ++i)
      {
        const ContactGroup &group   = *system.layout.contact_groups[i];
        const auto         &margins = groups[i].margins;
        for (unsigned int l = 0; l < margins.lines.size(); ++l)
          for (const Span &span : group.lines[l].spans)
            for (const Frame &frame : span.frames)
              for (const double *const q : places)
                if (!((frame.position(q) - frame.position(q_start.data())).norm() <= margins.lines[l]))
                  return group.name + ": " + group.lines[l].name;
        for (unsigned int b = 0; b < group.beads.size(); ++b)
          {
            const Vector3 x = group.position(group.beads[b], q_start.data());
            for (const double *const q : places)
              if (!((group.position(group.beads[b], q) - x).norm() <= margins.beads[b]))
                return group.name + ": " + group.beads[b].name;
          }
        for (unsigned int j = 0; j < group.surfaces.size(); ++j)
          {
            const Frame  &frame = group.surfaces[j].frame;
            const Vector3 x     = frame.position(q_start.data());
            const Matrix3 D     = frame.triad(q_start.data());
            for (const double *const q : places)
              if (!((frame.position(q) - x).norm() + (frame.triad(q) - D).norm() / std::sqrt(2.) * margins.reach <=
                    margins.surfaces[j]))
                return group.name + ": " + group.surfaces[j].name;
          }
      }
    return "";
  }



  std::string
  StageContacts::passed_unseen(const std::vector<Point<double>> &stages, const double *const end) const
  {
    constexpr double part_of_radius = 0.1; // less is the chord of a path that is bent
    for (const Near &n : near)
      {
        const PairShape shape = n.group->shape(n.pair);
        if (shape.kind == PairShape::plane || shape.hollow)
          continue; // what is behind the wall goes on touching it
        const double sum    = shape.radius_a + shape.radius_b;
        const auto   from_a = [&](const double *const q) -> Vector3 {
          ContactGroup::Sides there;
          if (!n.group->find_sides(n.pair, q, there))
            return Vector3::Constant(std::nan(""));
          return PairMeasure<double>(shape, n.group->places<double>(n.pair, there, q, nullptr)).of_place;
        };
        if (n.is_touched)
          {
            if (n.forces.depth > 0.5 * sum)
              return n.group->name + ": " + n.group->name_of(n.pair) +
                     " press into each other by more than half of their radii, and might come out on the other side: "
                     "is the <Stiffness> too small";
            continue;
          }
        Vector3 before = from_a(q_start.data());
        for (unsigned int k = 0; k <= tableau.s; ++k)
          {
            const Vector3 after = from_a(k < tableau.s ? stages[k].q : end), way = after - before;
            const double  at = way.squaredNorm() > 0 ? std::clamp(-before.dot(way) / way.squaredNorm(), 0., 1.) : 0.;
            if ((before + at * way).norm() < sum - part_of_radius * std::min(shape.radius_a, shape.radius_b))
              return n.group->name + ": " + n.group->name_of(n.pair) +
                     " pass each other between two stages of the step";
            before = after;
          }
      }
    return "";
  }



  std::string
  StageContacts::energy_missing(const double *const end, const double allowed) const
  {
    for (unsigned int i = 0; i < groups.size(); ++i)
      {
        const ContactGroup &group  = *system.layout.contact_groups[i];
        const double        energy = group.energy(end);
        double              work = 0, largest = 0, forces = 0, size = 0;
        for (const auto &bead : group.beads)
          size = std::max(size, group.position(bead, end).lpNorm<Eigen::Infinity>());
        const Near *worst = nullptr;
        for (const Near &n : near)
          if (n.group == &group && n.is_touched)
            {
              work += group.part_of(n.pair) * n.forces.elastic;
              for (unsigned int k = 0; k < tableau.s; ++k)
                forces += group.part_of(n.pair) * std::abs(n.forces.force[k]);
              if (group.part_of(n.pair) * std::abs(n.forces.elastic) > largest)
                {
                  largest = group.part_of(n.pair) * std::abs(n.forces.elastic);
                  worst   = &n;
                }
            }
        change_of_energy[i] = energy - groups[i].energy;
        // gaps are known to round-off of places
        const double round_off = 1e-12 * (energy + groups[i].energy) + 1e-14 * forces * size;
        if (!(std::abs(change_of_energy[i] - work) <= allowed + round_off))
          return group.name + ": the potential of its contacts changes by " +
                 number_to_text("%.4g", change_of_energy[i]) + " J where their forces do the work of " +
                 number_to_text("%.4g", work) + " J" +
                 (worst != nullptr ? ", most at " + group.name_of(worst->pair) : "");
      }
    return "";
  }



  std::string
  StageContacts::refusal(const std::vector<Point<double>> &stages, const double *const end, const double allowed) const
  {
    for (const Near &n : near)
      if (n.is_lost)
        return n.group->name + ": the nearest places of " + n.group->name_of(n.pair) +
               " are not found, as where beams are parallel";
    for (const Near &n : near)
      if (n.bristles >= 0 && bristles[n.bristles].is_lost)
        return n.group->name + ": the plane in which " + n.group->name_of(n.pair) +
               " rub turns by nearly a right angle";
    if (const std::string who = moved_too_far(stages, end); !who.empty())
      return who + " goes farther in the step than its speed at the start says";
    if (const std::string who = passed_unseen(stages, end); !who.empty())
      return who;
    return energy_missing(end, allowed);
  }



  void
  StageContacts::account(StepResult &result) const
  {
    for (const double change : change_of_energy)
      result.work_of_loads -= change;
    for (const Near &n : near)
      if (n.is_touched)
        {
          const double part = n.group->part_of(n.pair);
          result.viscous_loss += part * n.forces.loss;
          result.friction_loss += n.friction_loss;
          result.work_defect += part * std::abs(n.forces.work_defect);
        }
    for (const Bristles &b : bristles)
      {
        result.work_of_loads -= b.elastic; // a potential
        result.friction_loss += b.loss;
        result.dissipated += b.dissipated;
      }
    result.friction_loss += lost_at_start;
    result.work_of_loads += lost_at_start;
  }



  std::string
  StageContacts::touched() const
  {
    for (const Near &n : near)
      if (n.is_touched)
        return n.group->name + ": " + n.group->name_of(n.pair);
    return "";
  }



  StageContacts::Couplings
  StageContacts::couplings() const
  {
    const Layout             &layout = system.layout;
    Couplings                 result;
    std::vector<unsigned int> nodes;
    for (const Near &n : near)
      {
        n.group->nodes_of(n.pair, nodes);
        for (const auto a : nodes)
          for (const auto b : nodes)
            if (a != 0 && b != 0 && layout.pattern->position(layout.of_node(a), layout.of_node(b)) < 0)
              result.emplace_back(a, b);
      }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }



  void
  StageContacts::add_matrices(const Point<double> &point, const ContactGroup::AddBlocks &add, const int stage) const
  {
    for (const Near &n : near)
      if (n.bristles < 0)
        n.group->add_matrices(n.pair, point, add);
      else
        {
          const Bristles    &b = bristles[n.bristles];
          const BentBristles bent{n.is_touched ? b.stages[stage < 0 ? tableau.s / 2 : stage] : b.start,
                                  n.group->share_of(n.pair),
                                  step};
          n.group->add_matrices(n.pair, point, add, &bent);
        }
  }
} // namespace samara
