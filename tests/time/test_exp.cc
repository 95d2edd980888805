#include "../scene.h"
#include <samara/time/integrator.h>
#include <samara/time/projection.h>
#include <gtest/gtest.h>
using namespace samara;
namespace {
  const std::string two_bodies = R"(
subsection Bodies
  subsection a
    set Type = rigid body
    set Mass = 2
    set Position = 0.5, 0, 0
    set Centre of mass = 0.1, 0.05, -0.1
    set Inertia = 0.1, 0.2, 0.25, 0.01, 0.02, -0.01
    set Frames = pivot at 0 0 0, hinge at 1 0 0
  end
  subsection b
    set Type = rigid body
    set Mass = 1
    set Position = 1.5, 0, 0
    set Centre of mass = 0, 0.1, 0.1
    set Inertia = 0.1, 0.1, 0.15
  end
end
subsection Joints
  subsection ball
    set Type = spherical
    set Body A = ground
    set Body B = a.pivot
  end
  subsection hinge
    set Type = revolute
    set Body A = a.hinge
    set Body B = b.centre
    set Position = 1, 0, 0
    set Axis = 0, 1, 1
  end
end
)";
  std::string beam(double EA) { return R"(
subsection Sections
  subsection s
    set Type = engineering constants
    set EA = )" + std::to_string(EA) + R"(
    set GA2 = )" + std::to_string(EA) + R"(
    set GA3 = )" + std::to_string(EA) + R"(
    set GJ = 10
    set EI2 = 10
    set EI3 = 10
    set Mass = 1
    set I2 = 0.01
    set I3 = 0.01
  end
end
subsection Bodies
  subsection rod
    set Type = beam
    set Points = 0, 0, 0; 2, 0, 0
    set Elements = 3
    set Degree = 3
    set Section = s
  end
end
)";}
}
void go(System &system, State state, unsigned s, double rho, double h, unsigned n, const char *what)
{
  Integrator integrator(system, Tableau(s, rho), 1e-12);
  unsigned i = 0, worst = 0;
  double err = 0;
  const auto E = [&]() { auto e = system.energy(state); return e.kinetic + e.strain; };
  const double E0 = E();
  for (; i < n; ++i)
    {
      const double before = E();
      const auto r = integrator.step(state, h);
      if (!r.converged) { printf("   last correction %g after %u\n", r.last_correction, r.iterations); break; }
      worst = std::max(worst, r.iterations);
      err = std::max(err, std::abs(E() - before + r.dissipated) / E0);
    }
  printf("%s s %u rho %.1f h %g: steps %u/%u it/step %.2f worst %u fact/step %.2f err %.1e E/E0 %.4f\n", what, s, rho, h, i, n, double(integrator.n_iterations) / std::max(1u,integrator.n_steps), worst, double(integrator.n_factorizations) / std::max(1u,integrator.n_steps), err, E()/E0);
}
TEST(Exp, Bodies)
{
  Scene scene(two_bodies);
  State state = scene.system.reference();
  for (unsigned int i = 6; i < state.y.size(); ++i) state.y[i] = 2 * std::sin(1.3 * (i - 5));
  Projection(scene.system).velocities(state);
  printf("spins %g %g\n", Eigen::Map<Vector3>(&state.y[9]).norm(), Eigen::Map<Vector3>(&state.y[15]).norm());
  for (unsigned s : {1, 2, 3}) for (double rho : {1., 0.5, 0.}) for (double h : {0.01, 0.05, 0.2, 0.4, 0.6})
    go(scene.system, state, s, rho, h, 40, "bodies");
}
TEST(Exp, Beam)
{
  for (double EA : {1e4, 1e8, 1e12}) {
  Scene scene(beam(EA));
  State state = scene.system.reference();
  const double spin = 3, bending = 1.5;
    for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
      {
        const double x = scene.system.model.nodes[node].x(0) - 1;
        Eigen::Map<Vector6>(&state.y[6 * node]) << 0.3, spin * x, bending * x * x, 0.2, 0, spin;
      }
  printf("EA %g\n", EA);
  for (unsigned s : {1, 2, 3}) for (double rho : {1., 0.5, 0.}) for (double h : {0.005, 0.02, 0.1, 0.3})
    go(scene.system, state, s, rho, h, 40, "beam");
  }
}
