#include <samara/joints/thread_friction.h>

#include <array>
#include <cmath>

namespace samara
{
  /** u − sin λ d − r cos λ θ = 0. */
  class ThreadFriction::Slip : public Evaluated<ThreadFriction::Slip, Constraint>
  {
  public:
    Slip(Layout                            &layout,
         const std::string                 &joint,
         const std::array<unsigned int, 3> &coordinates,
         const std::array<double, 3>       &factors)
      : coordinates(coordinates)
      , factors(factors)
      , multiplier(layout.add_multipliers({"joint " + joint + ", slip of the thread"}))
    {
      layout.couple(block, {}, {coordinates.begin(), coordinates.end()}, {multiplier});
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          r[block.row(i)] += factors[i] * point.multipliers[multiplier];
          r[block.row(3)] += factors[i] * point.coordinates[coordinates[i]];
        }
    }

    void
    tangent(const Point<double> &, SparseMatrix &K) const override
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          block.add_entry(i, 3, factors[i], K);
          block.add_entry(3, i, factors[i], K);
        }
    }

    void
    rates(const Point<double> &point, double *rates) const override
    {
      rates[multiplier] = 0;
      for (unsigned int i = 0; i < 3; ++i)
        rates[multiplier] += factors[i] * point.rates[coordinates[i]];
    }

  private:
    const std::array<unsigned int, 3> coordinates; ///< u, d, θ
    const std::array<double, 3>       factors;
    const unsigned int                multiplier;
    Block                             block;
  };



  ThreadFriction::ThreadFriction()  = default;
  ThreadFriction::~ThreadFriction() = default;



  void
  ThreadFriction::add_parameters(Parameters &screw)
  {
    Parameters &prm = screw.subsection("thread");
    entries.add_parameters(prm, false, false);
    prm.add("Radius", radius, "Mean radius of the thread [m].", dealii::Patterns::Double(0));
    prm.add("Flank angle",
            flank_angle,
            "Of a flank against the plane normal to the axis, seen in a section through the axis; 0: a square thread, "
            "15 deg: a trapezoidal one [rad].",
            dealii::Patterns::Double(0, 1.5));
    prm.add("Friction preload",
            entries.preload,
            "Force along the axis that presses besides what the thread transmits, as of two nuts that are braced [N].",
            dealii::Patterns::Double(0));
  }



  void
  ThreadFriction::initialize(Model &model, const Item &joint, const Parameters &prm)
  {
    slip = bristles = -1;
    if (!entries.is_given())
      return;
    law = entries.law(prm, "friction of the thread", model.complaints);
    if (radius == 0)
      model.complaints.add(prm.where("Friction"),
                           "joint <" + joint.name + ">: the friction of the thread needs its <Radius> above zero");
    slip = model.add_coordinate(joint.name + ".slip of the thread", "m");
    if (law.has_bristles())
      bristles = model.add_state(joint.name + ".thread bristles", "m", 0., 1.);
  }



  void
  ThreadFriction::connect(Layout            &layout,
                          const Item        &joint,
                          const unsigned int displacement,
                          const unsigned int rotation,
                          const unsigned int row,
                          const double       pitch)
  {
    terms.clear();
    if (slip < 0 || radius == 0)
      return;
    const double lead = std::atan2(std::abs(pitch), radius), sense = pitch < 0 ? -1 : 1,
                 tilt = std::atan(std::tan(flank_angle) * std::cos(lead));
    term =
      std::make_unique<Slip>(layout,
                             joint.name,
                             std::array<unsigned int, 3>{{static_cast<unsigned int>(slip), displacement, rotation}},
                             std::array<double, 3>{{1., -std::sin(lead), -sense * radius * std::cos(lead)}});
    layout.add(joint, *term);
    // the multiplier of the pitch is the force along the axis: the law's coefficients make the one normal to the flanks
    const double     normal = 1 / (std::cos(lead) * std::cos(tilt));
    Layout::Friction friction;
    friction.coordinates = {static_cast<unsigned int>(slip)};
    if (bristles >= 0)
      friction.states = {static_cast<unsigned int>(bristles)};
    friction.law = law;
    friction.law.kinetic *= normal;
    friction.law.breakaway *= normal;
    friction.preload     = entries.preload;
    friction.multipliers = {row};
    friction.name        = "joint " + joint.name + ", friction of the thread";
    terms.add_friction(layout, joint, friction);
  }
} // namespace samara
