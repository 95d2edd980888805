#ifndef samara_tests_states_scenes_h
#define samara_tests_states_scenes_h

#include <string>

namespace samara
{
  /** 2 kg on a slide along z, with @p states of first order and the entries of the slide's displacement. */
  inline std::string
  on_a_slide(const std::string &states, const std::string &displacement)
  {
    return "subsection States\n" + states + R"(end
subsection Bodies
  subsection m
    set Type = rigid body
    set Mass = 2
    set Inertia = 1, 1, 1
    set Velocity = 0, 0, 1
  end
end
subsection Joints
  subsection slide
    set Type = prismatic
    set Body A = ground
    set Body B = m.centre
    subsection displacement
)" + displacement +
           "\n    end\n  end\nend\n";
  }



  /** On a spring with a lag of its motion that pushes back, and a damper that saturates. */
  inline std::string
  oscillator_with_lag()
  {
    return on_a_slide(R"(
  subsection lag
    set Rate = (slide.displacement + 0.2*slide.displacement^3 - lag + 0.1*sin(3*t))/(0.15 s)
    set Initial = 0.4
  end
)",
                      R"(
      set Spring = 50
      set Force = 3 N*cos(2*t) - 20 N * lag - 4 N * tanh(slide.displacement rate / 0.5 m/s)
)");
  }



  /** A body on a ball joint with moments and a force that depend on its motion and on two states. */
  inline std::string
  top_with_controls()
  {
    return R"(
subsection States
  subsection roll
    set Rate = (b.angular velocity x - roll)/(0.2 s)
    set Unit = rad/s
  end
  subsection drift
    set Rate = 2*b.tip.displacement y - drift*abs(2 + b.tip.velocity z)
    set Initial = 0.3
    set Unit = m
  end
end
subsection Bodies
  subsection b
    set Type = rigid body
    set Mass = 1.5
    set Position = 0, 0, 0.4
    set Inertia = 0.3, 0.25, 0.1
    set Frames = tip at 0.1 0.2 0.8
    set Angular velocity = 0.5, 0.3, 6
    set Velocity = 0.12, -0.2, 0
  end
end
subsection Joints
  subsection ball
    set Type = spherical
    set Body A = ground
    set Body B = b.centre
    set Position = 0, 0, 0
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
  subsection control
    set Type = point load
    set At = b.tip
    set Force = -2*drift, 0.5*sin(b.angular velocity y), -0.3*b.tip.velocity x
    set Moment = -0.4*roll, 0, 0.1*b.tip.position x*b.tip.position y
  end
  subsection follower
    set Type = point load
    set At = b.centre
    set Axes = body
    set Force = 0, -0.5*tanh(b.velocity y), 0
  end
end
)";
  }
} // namespace samara

#endif
