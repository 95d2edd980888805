// Lateral buckling of narrow beams and frames. The references are linear buckling loads, which neglect how far the beam
// has sagged before; the models' greater bending stiffness is therefore 1e6 times the lesser (beams), or 1000 times
// that of the real section (frames: 2.5e6 times the lesser), and what is left is of the order of this ratio.
//
// References: solutions of the differential equations, 12 digits. Cantilever: end force P L²/sqrt(EI GJ)
// = 4.01259934358, uniform load q L³/sqrt(EI GJ) = 12.8537633214, end moment by a pair of dead forces
// (quasi-tangential) π/2; between forks: moment π, force in the middle 16.9361321505, uniform load 28.3149570727.
// Right-angle frame (Argyris et al. 1979, L = 240, b = 30, t = 0.6, E = 71240, ν = 0.31, GJ = G b t³/3), dead end force
// along ±x, ±y: 1.08675749196 (1.088 ... 1.09 in the literature, with the sag), 0.680235302094,
// 0.650752494162, 3.96917786262.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  const std::string lateral_buckling = "prm/benchmarks/lateral_buckling.prm";

  /** The beam, with the subsection Bodies left open for more. */
  const std::string beam_and_more =
    "subsection Bodies\n subsection beam\n set Type = beam\n set Points = 0, 0, 0; 1, 0, 0\n"
    " set Section = strip\n set Elements = 8\n end\n";

  const std::string sags = "subsection Loads\n subsection force\n set Type = line load\n set Body = beam\n"
                           " set Force = 0, 0, -P\n end\nend\n";

  /** Forks: ends that bend in both directions but neither shift sideways nor twist; @p moment bends both. */
  std::string
  forks(const std::string &moment)
  {
    const std::string tilt = " set Type = universal\n set Axis = 0, 1, 0\n set Second axis = 0, 0, 1\n"
                             " subsection rotation 1\n set Moment = ";
    return beam_and_more +
           " subsection slider\n set Type = rigid body\n set Position = 1, 0, 0\n end\nend\n"
           "subsection Joints\n subsection left\n set Body A = ground\n set Body B = beam.start\n" +
           tilt + moment + "\n end\n end\n subsection right\n set Body A = slider.centre\n set Body B = beam.end\n" +
           tilt + "-(" + moment +
           ")\n end\n end\n subsection guide\n set Type = prismatic\n set Body A = ground\n set Body B = slider.centre\n"
           " set Axis = 1, 0, 0\n end\nend\n";
  }

  std::string
  middle_force()
  {
    return "subsection Loads\n subsection force\n set Type = point load\n set At = beam.middle\n set Force = 0, 0, -P\n"
           " end\nend\n";
  }
} // namespace



TEST(LateralBuckling, Cantilever)
{
  EXPECT_NEAR(buckling_load(lateral_buckling, 2, 5), 4.01259934358, 2e-5);
  EXPECT_NEAR(buckling_load(with_part(lateral_buckling, "Loads", "Modal", sags), 8, 15), 12.8537633214, 5e-5);
}



// Dead forces along x at the ends of a bar across the tip: their moment follows the twist of the tip but not its slope.
TEST(LateralBuckling, CantileverUnderEndMoment)
{
  const std::string text = R"(
  subsection bar
    set Type = rigid body
    set Position = 1, 0, 0
    set Frames = top at 1 0 0.5, bottom at 1 0 -0.5
  end
end
subsection Joints
  subsection root
    set Type = rigid
    set Body A = ground
    set Body B = beam.start
  end
  subsection tip
    set Type = rigid
    set Body A = beam.end
    set Body B = bar.centre
  end
end
subsection Loads
  subsection pull
    set Type = point load
    set At = bar.top
    set Force = P, 0, 0
  end
  subsection push
    set Type = point load
    set At = bar.bottom
    set Force = -P, 0, 0
  end
end
)";
  EXPECT_NEAR(buckling_load(with_part(lateral_buckling, "Bodies", "Modal", beam_and_more + text), 1, 2),
              M_PI / 2,
              1e-5);
}



TEST(LateralBuckling, BetweenForks)
{
  EXPECT_NEAR(buckling_load(with_part(lateral_buckling, "Bodies", "Modal", forks("P")), 2, 4), M_PI, 2e-5);
  EXPECT_NEAR(buckling_load(with_part(lateral_buckling, "Bodies", "Modal", forks("0") + middle_force()), 12, 20),
              16.9361321505,
              1e-4);
  EXPECT_NEAR(buckling_load(with_part(lateral_buckling, "Bodies", "Modal", forks("0") + sags), 22, 32),
              28.3149570727,
              1e-4);
}



TEST(LateralBuckling, RightAngleFrame)
{
  const std::string frame = "prm/benchmarks/right_angle_frame.prm";
  EXPECT_NEAR(buckling_load(frame, 0.8, 1.2, "Px"), 1.08675749196, 1e-5);
  EXPECT_NEAR(buckling_load(frame, -0.5, -0.8, "Px"), -0.680235302094, 1e-5);
  const auto along_y = [&](const double a, const double b) {
    return root_of(
      [&](const double P) {
        Scene scene = with_constants(frame, {"Px = 0", "Py = " + exact(P)});
        scene.equilibrium();
        return smallest_square(scene.modes());
      },
      a,
      b);
  };
  EXPECT_NEAR(along_y(0.5, 0.8), 0.650752494162, 1e-5);
  EXPECT_NEAR(along_y(-3.5, -4.5), -3.96917786262, 1e-4);
}



// The hinged right-angle frame (Argyris et al. 1979): both legs 240 long, bent in their plane by moments ±M at their
// feet, which turn about z only; one foot slides along x. Reference: 622.20808722 for both signs, solution of the
// differential equations of half a frame that buckles symmetrically, without the deflection before buckling.
TEST(LateralBuckling, HingedFrame)
{
  const std::string foot = " set Body A = ground\n set Axis = 0, 0, 1\n";
  const std::string text = "subsection Bodies\n subsection frame\n set Type = beam\n set Section = strip\n"
                           " set Points = 0, 0, 0; side/sqrt(2), side/sqrt(2), 0; sqrt(2)*side, 0, 0\n"
                           " set Axis 2 = -1, 1, 0\n set Elements = 8\n end\nend\n"
                           "subsection Joints\n subsection left\n set Type = revolute\n set Body B = frame.start\n" +
                           foot + " subsection rotation\n set Moment = Px\n end\n end\n" +
                           " subsection right\n set Type = planar\n set Body B = frame.end\n set Axis 1 = 0, 1, 0\n" +
                           foot + " subsection rotation\n set Moment = -Px\n end\n" +
                           " subsection displacement 1\n set Prescribed = 0\n end\n end\nend\n";
  const std::string model = with_part("prm/benchmarks/right_angle_frame.prm", "Bodies", "Modal", text);
  EXPECT_NEAR(buckling_load(model, 500, 700, "Px"), 622.20808722, 622e-5);
  EXPECT_NEAR(buckling_load(model, -500, -700, "Px"), -622.20808722, 622e-5);
}
