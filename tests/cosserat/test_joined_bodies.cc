// Bodies whose elements are computed together have the strains, rates and forces that each has by itself, in any order
// of bodies, degrees and what stands between them.

#include <samara/cosserat/cosserat.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  /** Beams of 1, 5, 2 and 1 elements of degrees 3, 2, 3 and 3, viscous ones among them, one with a corner and one that
   * is rigid; between them a hinge with a spring, whose strain stands among those of the beams; two shells. */
  const std::string many_bodies = R"(
subsection Sections
  subsection s
    set Type = rectangle
    set E = 70e9
    set Density = 2700
    set Width 2 = 0.02
    set Width 3 = 0.03
  end
end
subsection Bodies
  subsection a
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Degree = 3
    set Section = s
  end
  subsection b
    set Type = beam
    set Points = 1, 0, 0; 2, 0.3, 0.1; 3, 0, 0
    set Elements = 5
    set Degree = 2
    set Section = s
    set Damping = 1e-3
  end
  subsection stiff
    set Type = beam
    set Points = 3, 0, 0; 4, 0, 0
    set Degree = 3
    set Section = s
    set Rigid = true
  end
  subsection c
    set Type = beam
    set Points = 4, 0, 0; 4, 1, 0
    set Elements = 2
    set Degree = 3
    set Section = s
  end
  subsection d
    set Type = beam
    set Points = 4, 1, 0; 4, 1, 1
    set Degree = 3
    set Section = s
  end
  subsection e
    set Type = shell
    set Patches = u, 1 + v, 0.1*u*v
    set Elements = 2, 1
    set Degree = 2
    set E = 70e9
    set Poisson ratio = 0.3
    set Thickness = 0.01
    set Density = 2700
  end
  subsection f
    set Copy of = e
    set Patches = 2 + u, 1 + v, 0
    set Elements = 1, 3
  end
end
subsection Joints
  subsection hinge
    set Type = revolute
    set Body A = a.end
    set Body B = b.start
    subsection rotation
      set Spring = 3
    end
  end
end
)";



  /** Anywhere, deformed, in motion, under stress. */
  State
  anywhere(const System &system)
  {
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> number(-0.1, 0.1);
    State                                  state = system.reference();
    for (auto *const values : {&state.q, &state.coordinates, &state.y, &state.rates, &state.stress})
      for (unsigned int i = values == &state.q ? 12 : values == &state.y ? 6 : 0; i < values->size(); ++i)
        (*values)[i] += number(random);
    return state;
  }



  /** The deformations of bodies, each by itself. */
  std::vector<const Deformation *>
  bodies_of(const Model &model)
  {
    std::vector<const Deformation *> bodies;
    for (const auto &item : model.items)
      if (const auto *const body = dynamic_cast<const Deformation *>(item.get());
          body != nullptr && body->item != nullptr)
        bodies.push_back(body);
    return bodies;
  }



  /** Largest difference of what @p body has to what is in the same places of all strains. */
  double
  difference(const Deformation &body, const std::vector<double> &alone, const std::vector<double> &together)
  {
    double largest = 0;
    for (unsigned int i = 0; i < body.n_strains(); ++i)
      largest = std::max(largest, std::abs(alone[i] - together[body.first_strain + i]));
    return largest;
  }
} // namespace



TEST(JoinedBodies, HaveTheirOwnStrains)
{
  const Scene scene(many_bodies);
  const State state  = anywhere(scene.system);
  const auto  bodies = bodies_of(scene.input.model);
  ASSERT_EQ(bodies.size(), 6u); // what is rigid has none

  std::vector<double> strains, rates(scene.system.layout.n_strains), stresses;
  scene.system.strains(state, strains);
  scene.system.strain_rates(state.point(), rates.data());
  scene.system.stresses(state, stresses);
  for (const auto *const body : bodies)
    {
      std::vector<double> own(body->n_strains()), own_rates(own), own_stresses(own);
      body->strains(state.point(), own.data());
      body->strain_rates(state.point(), own_rates.data());
      body->stresses(own.data(), own_rates.data(), own_stresses.data());
      // the same instructions in whichever lane
      EXPECT_EQ(difference(*body, own, strains), 0);
      EXPECT_EQ(difference(*body, own_rates, rates), 0);
      EXPECT_EQ(difference(*body, own_stresses, stresses), 0);
    }
}



TEST(JoinedBodies, HaveTheirOwnForces)
{
  const Scene scene(many_bodies);
  const State state  = anywhere(scene.system);
  const auto  bodies = bodies_of(scene.input.model);

  // without velocities and multipliers the residual is that of stresses alone: no loads, no springs but one
  std::vector<double> all(scene.system.size() + 6, 0.), own(all);
  scene.system.add_terms(state.point(), all.data());
  scene.system.add_loads(state.point(), own.data());
  scene.system.add_constraints(state.point(), own.data());
  for (const auto *const body : bodies)
    body->residual(state.point(), own.data());
  // and what is left is the spring of the hinge alone: its coordinate, and nothing at nodes
  double largest = 0;
  for (unsigned int i = 0; i < all.size(); ++i)
    if (static_cast<int>(i) != scene.system.layout.of_coordinate(0))
      largest = std::max(largest, std::abs(all[i] - own[i]));
  EXPECT_LT(largest, 1e-14);
}



TEST(JoinedBodies, HaveTheirOwnLinearStrains)
{
  const Scene scene(many_bodies);
  const State state  = anywhere(scene.system);
  const auto  bodies = bodies_of(scene.input.model);
  const auto  linear = scene.system.linear_strains();
  auto        point  = state.point();

  const std::vector<double> no_multipliers(scene.system.layout.n_multipliers, 0.);
  point.multipliers = no_multipliers.data();
  linear->renew(point);
  std::vector<double> rates(scene.system.layout.n_strains), forces(scene.system.size() + 6, 0.), own_forces(forces);
  linear->strains(state.y.data(), state.rates.data(), rates.data());
  linear->add_forces(state.stress.data(), forces.data());
  for (const auto *const body : bodies)
    {
      std::vector<double> own(body->n_strains());
      const auto          own_linear = body->linear_strains();
      own_linear->renew(point);
      own_linear->strains(state.y.data(), state.rates.data(), own.data());
      own_linear->add_forces(state.stress.data() + body->first_strain, own_forces.data());
      EXPECT_EQ(difference(*body, own, rates), 0);
    }
  double largest = 0;
  for (unsigned int i = 0; i < forces.size(); ++i)
    if (static_cast<int>(i) != scene.system.layout.of_coordinate(0))
      largest = std::max(largest, std::abs(forces[i] - own_forces[i]));
  EXPECT_LT(largest, 1e-14);
}
