// Whirl flutter of a propeller on a pylon, by modes and by motion, against closed forms.

#include <samara/analysis/modal.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include "growth.h"
#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  using Complex = std::complex<double>;

  // four blades from 0.3 to 1.5 m of chord 0.2 m, turning at 80 rad/s, half a metre ahead of the hinges of the pylon
  const double Omega = 80, arm = 0.5, polar = 4, transverse = 2.5, mass = 6, spring = 18000;

  /**
   * J. C. Houbolt & W. H. Reed, J. Aerospace Sci. 29 (1962), for blades without a mean load, whose twist is that of
   * windmilling: what they meet across their path makes lift. With z = θ + iψ of the two tilts, A, B, D the sums over
   * blades of ½ρca ∫ (Ω²r⁴, ΩVr², V²)/U dr, two for four of them:
   *
   *     I z̈ + (A + ℓ²D − iJΩ) ż + (k − ℓDV + iBV) z = 0
   */
  std::vector<Complex>
  whirl(const double V)
  {
    const double half_slope = 0.5 * 1.225 * 0.2 * 2 * M_PI, I = transverse + mass * arm * arm;
    double       A = 0, B = 0, D = 0;
    const int    n = 2000;
    for (int i = 0; i < n; ++i)
      {
        const double r = 0.3 + 1.2 * (i + 0.5) / n, c = 2 * half_slope * 1.2 / n / std::hypot(V, Omega * r);
        A += c * Omega * Omega * std::pow(r, 4);
        B += c * Omega * V * r * r;
        D += c * V * V;
      }
    const Complex        b(A + arm * arm * D, -polar * Omega), c(spring - arm * D * V, B * V);
    const Complex        root = std::sqrt(b * b - 4 * I * c);
    std::vector<Complex> both = {(-b + root) / (2 * I), (-b - root) / (2 * I)};
    for (auto &lambda : both) // of a pair
      lambda = {lambda.real(), std::abs(lambda.imag())};
    return both;
  }

  std::string
  propeller(const double V)
  {
    std::string surfaces;
    for (unsigned int k = 0; k < 4; ++k)
      {
        const int  x = k == 0 ? 1 : k == 2 ? -1 : 0, y = k == 1 ? 1 : k == 3 ? -1 : 0;
        const auto at = [&](const double r) {
          return number_to_text(x * r) + ", " + number_to_text(y * r) + ", " + number_to_text(arm);
        };
        // strips without width: chord and density by a million
        surfaces += subsection("blade " + std::to_string(k + 1),
                               "    set Body = propeller\n    set Line = " + at(0.3) + "; " + at(1.5) +
                                 "\n    set Leading edge = " + number_to_text(-y) + ", " + number_to_text(x) +
                                 ", 0\n    set Upper side = 0, 0, 1\n    set Chord = 0.2e-6\n    set Twist = atan2(" +
                                 number_to_text(V) +
                                 ", 80*(s + 0.3))\n"
                                 "    set Airfoils = plate\n    set Stations = 8\n    set Unsteady = quasi-steady\n");
      }
    return R"(
set Analyses = static, modal
subsection Bodies
  subsection pylon
    set Type    = rigid body
    set Mass    = 1
    set Inertia = 0.5, 0.5, 0.5
  end
  subsection propeller
    set Type     = rigid body
    set Mass     = 6
    set Inertia  = 2, 2, 4
    set Position = 0, 0, 0.5
  end
end
subsection Joints
  subsection hinges
    set Type        = universal
    set Body A      = ground
    set Body B      = pylon.centre
    set Axis        = 1, 0, 0
    set Second axis = 0, 1, 0
    subsection rotation 1
      set Spring = 18000
    end
    subsection rotation 2
      set Spring = 18000
    end
  end
  subsection shaft
    set Type   = revolute
    set Body A = pylon
    set Body B = propeller.centre
    set Axis   = 0, 0, 1
    subsection rotation
      set Prescribed = 80*t
    end
  end
end
subsection Loads
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 80
  end
end
subsection Airfoils
  subsection plate
    set Type = analytic
    set Form = linear
  end
end
)" + subsection("Aerodynamics", air("0, 0, " + number_to_text(-V), "    set Density = 1.225e6\n")) +
           subsection("Surfaces", surfaces);
  }

  /** Of the tilt that grows or decays last, after a blow that sets the propeller whirling backward. */
  Complex
  grown(const double V, const double h, const unsigned int n)
  {
    Scene scene(propeller(V));
    scene.equilibrium();
    State       &state = scene.context.state;
    const Probe  tilt  = scene.input.model.probe("hinges.rotation 1");
    const double rate  = 1e-6;
    for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
      {
        // the twist of a rotation about x through the hinges
        const Vector3 spin = state.triad(node).transpose() * Vector3(rate, 0, 0);
        const Vector3 v    = state.triad(node).transpose() * Vector3(rate, 0, 0).cross(state.position(node));
        for (unsigned int i = 0; i < 3; ++i)
          {
            state.y[6 * node + i] += v(i);
            state.y[6 * node + 3 + i] += spin(i);
          }
      }
    state.held = false;
    Projection(scene.system).velocities(state);
    StageIntegrator     integrator(scene.system, Tableau(3, 1.), 1e-12, 50);
    std::vector<double> values;
    for (unsigned int i = 0; i < n; ++i)
      {
        EXPECT_TRUE(integrator.step(state, h).converged);
        if (2 * i >= n)
          values.push_back(tilt.value(state));
      }
    return growth_of(values, h);
  }
} // namespace



TEST(WhirlFlutter, ByModesAndByMotion)
{
  for (const double V : {50., 80.})
    {
      const auto expected = whirl(V);
      Scene      scene(propeller(V));
      scene.equilibrium();
      const auto modes = scene.modes();
      for (const Complex &lambda : expected)
        {
          double nearest = 1e300;
          for (const auto &mode : modes)
            nearest = std::min(nearest, std::abs(Complex(mode.lambda.real(), std::abs(mode.lambda.imag())) - lambda));
          EXPECT_LT(nearest, 1e-5 * std::abs(lambda)) << V << " " << lambda;
        }
      const Complex last = expected[0].real() > expected[1].real() ? expected[0] : expected[1];
      EXPECT_EQ(last.real() > 0, V > 60) << last; // slow flight is stable, fast flight is not
      EXPECT_LT(std::abs(grown(V, 0.004, 250) - last), 1e-3 * std::abs(last)) << V << " " << last;
    }
}
