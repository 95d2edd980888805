// The couple that damps pitch, with virtual mass and without it: torsion in hover, coned blades, air from behind.

#include <samara/analysis/modal.h>
#include <samara/analysis/static.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  const double spin_rate = 30, air_density = 1.225, half_chord = 0.1, root_radius = 0.6, tip_radius = 3,
               pitch_spring = 500, pitch_inertia = 0.05;

  /**
   * A rigid blade that turns at 30 rad/s and feathers about its quarter chord against a spring; it is coned by an angle
   * and lives in the inflow <flow> if @p entries say so, whose hub is a point of @p hub.
   */
  std::string
  feathering_blade(const double coning, const std::string &entries, const std::string &hub = "ground")
  {
    const auto along = [=](const double r) {
      return number_to_text(r * std::cos(coning)) + ", 0, " + number_to_text(r * std::sin(coning));
    };
    const std::string body = R"(    set Type             = rigid body
    set Mass             = 5
)";
    return subsection("Bodies",
                      "  subsection hub\n" + body + "    set Inertia = 2, 2, 4\n  end\n  subsection blade\n" + body +
                        "    set Inertia = 0.05, 5, 5.05\n    set Position = " + along(1.8) +
                        "\n    set Rotation = 0, " + number_to_text(-coning) + ", 0\n  end\n") +
           subsection("Joints",
                      R"(
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = hub.centre
    set Axis   = 0, 0, 1
  end
  subsection pitch
    set Type   = revolute
    set Body A = hub.centre
    set Body B = blade.centre
    set Position = 0, 0, 0
    set Axis   = )" + along(1) +
                        R"(
    subsection rotation
      set Spring = 500
    end
  end
)") + subsection("Loads", R"(
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 30
  end
)") + airfoils() +
           subsection("Aerodynamics",
                      air("0, 0, 0") + "  subsection flow\n    set Type = prescribed inflow\n    set Hub = " + hub +
                        "\n    set Axis = 0, 0, 1\n    set Radius = 3\n  end\n") +
           subsection("Surfaces",
                      subsection("blade",
                                 "    set Body = blade\n    set Line = " + along(root_radius) + "; " +
                                   along(tip_radius) +
                                   "\n    set Leading edge = 0, 1, 0\n    set Chord = 0.2\n    set Airfoils = thin\n" +
                                   entries)) +
           subsection("Modal", "  set Modes = 20\n");
  }

  std::string
  with_thin_airfoil(std::string model)
  {
    const std::string start = "subsection Airfoils\n";
    return model.insert(model.find(start) + start.size(), "  subsection thin\n    set Type = analytic\n  end\n");
  }

  Mode
  torsion(const std::string &model)
  {
    Scene scene(with_thin_airfoil(model));
    scene.equilibrium();
    for (const auto &mode : scene.modes())
      if (mode.lambda.imag() > 50)
        return mode;
    throw std::logic_error("there is no torsion");
  }

  double
  ratio_of(const Mode &mode)
  {
    return -mode.lambda.real() / std::abs(mode.lambda);
  }
} // namespace



// −πρVb³ϑ̇ along the blade, V = Ωr: of a blade that feathers about its quarter chord lift does no work, and the damping
// ratio is πρb³Ω ∫r dr/(2 I ω), whatever is unsteady and whether the mass of the air counts.
TEST(PitchDamping, OfTorsionInHover)
{
  const double exact = M_PI * air_density * half_chord * half_chord * half_chord * spin_rate *
                       (tip_radius * tip_radius - root_radius * root_radius) / 2 /
                       (2 * std::sqrt(pitch_inertia * pitch_spring));
  for (const std::string unsteady : {"quasi-steady", "two lags"})
    {
      const std::string entry = "    set Unsteady = " + unsteady + "\n";
      // a flat blade has the same frequency at rest and turning: I_z − I_y = I
      EXPECT_NEAR(ratio_of(torsion(feathering_blade(0, entry))),
                  exact * std::sqrt(pitch_spring / (pitch_spring + pitch_inertia * spin_rate * spin_rate)),
                  1e-3 * exact)
        << unsteady;
      const Mode with_mass = torsion(feathering_blade(0, entry + "    set Virtual mass = true\n"));
      EXPECT_NEAR(ratio_of(with_mass), ratio_of(torsion(feathering_blade(0, entry))), 1e-2 * exact) << unsteady;
    }
}



// A coned blade turns about itself with Ω sin β, which is camber for the air, half of the couple of a blade that
// pitches. So it is with the virtual mass and without it, be the hub of the inflow one that turns or not.
TEST(PitchDamping, OfConedBladesIsThatOfCamber)
{
  const double coning = 0.1, couple = M_PI / 2 * air_density * half_chord * half_chord * half_chord * spin_rate *
                                      std::cos(coning) * spin_rate * std::sin(coning) *
                                      (tip_radius * tip_radius - root_radius * root_radius) / 2;
  const auto pitch = [&](const std::string &entries, const std::string &hub) {
    Scene scene(with_thin_airfoil(feathering_blade(coning, "    set Unsteady = quasi-steady\n" + entries, hub)));
    scene.equilibrium();
    return scene.value("pitch.rotation") * M_PI / 180;
  };
  const double with_mass = pitch("    set Virtual mass = true\n    set Inflow = flow\n", "ground");
  // nose down against spring and propeller moment
  const double rigidity = pitch_spring + pitch_inertia * spin_rate * spin_rate * std::cos(coning) * std::cos(coning);
  EXPECT_NEAR(with_mass, -couple / rigidity, 0.02 * couple / rigidity);
  for (const std::string hub : {"ground", "hub.centre"})
    EXPECT_NEAR(pitch("    set Inflow = flow\n", hub), with_mass, 1e-4 * std::abs(with_mass)) << hub;
}



// It damps from wherever the air comes: power of a wing that turns about its quarter chord, nose up and nose down.
TEST(PitchDamping, TakesPowerWhereverTheAirComesFrom)
{
  for (const std::string wind : {"30, 0, 0", "-30, 0, 0"})
    for (const double spin : {0.5, -0.5})
      {
        Scene        scene(with_thin_airfoil(
          rigid_wing(air(wind), "    set Chord = 0.5\n    set Airfoils = thin\n    set Unsteady = quasi-steady\n")));
        const double at_rest         = scene.value("it.moment y");
        scene.context.state.y[6 + 4] = spin;
        EXPECT_LT((scene.value("it.moment y") - at_rest) * spin, 0.) << wind << " " << spin;
      }
}



// A wing 0.5 % below its divergence speed is stable with whatever mesh, from two elements on with one eigenvalue, and
// diverges where the closed form says, with the stations that a file asks for and more.
TEST(Stations, DivergenceWithAnyMesh)
{
  const auto growth = [](const unsigned int elements, const double U, const unsigned int stations) {
    std::string model = R"(
subsection Sections
  subsection wing
    set Type = engineering constants
    set EA   = 1e11
    set GA2  = 1e11
    set GA3  = 1e11
    set GJ   = 987000
    set EI2  = 9.77e6
    set EI3  = 1e11
    set Mass = 35.71
    set I2   = 0.01
    set I3   = 8
  end
end
subsection Bodies
  subsection wing
    set Type     = beam
    set Points   = 0, 0, 0; 0, 6.096, 0
    set Axis 2   = -1, 0, 0
    set Section  = wing
    set Elements = )" + std::to_string(elements) +
                        R"(
  end
end
subsection Joints
  subsection root
    set Type   = rigid
    set Body A = ground
    set Body B = wing.start
  end
end
)" + airfoils() + subsection("Aerodynamics", air(number_to_text(U) + ", 0, 0")) +
                        subsection("Surfaces", subsection("lift", R"(
    set Body          = wing
    set Chord         = 1.8288
    set Quarter chord = 0.146304
    set Airfoils      = thin
    set Upper side    = 0, 0, 1
    set Unsteady      = quasi-steady
    set Stations      = )" + std::to_string(stations) + "\n"));
    Scene  scene(with_thin_airfoil(model + subsection("Modal", "  set Modes = 4\n")));
    double real = -1e300;
    for (const auto &mode : scene.modes())
      if (mode.lambda.imag() == 0 && std::abs(mode.lambda) < 5)
        real = std::max(real, mode.lambda.real());
    return real;
  };
  const double exact = M_PI / 2 / 6.096 * std::sqrt(0.987e6 / (0.5 * 1.225 * 1.8288 * 0.146304 * 2 * M_PI));
  EXPECT_NEAR(exact, 252.28, 0.005);
  const double fine = growth(16, 251, 16);
  EXPECT_LT(fine, -0.3);
  for (const unsigned int elements : {2, 4, 8, 16})
    {
      EXPECT_NEAR(growth(elements, 251, 4), fine, 2e-3 * std::abs(fine)) << elements;
      EXPECT_LT(growth(elements, exact * (1 - 2e-4), 1), 0.) << elements;
      EXPECT_GT(growth(elements, exact * (1 + 2e-4), 1), 0.) << elements;
    }
}
