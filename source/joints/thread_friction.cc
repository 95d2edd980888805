#include <samara/joints/thread_friction.h>

#include <cmath>

namespace samara
{
  /** u − sin λ d − r cos λ θ = 0; of a nut on a beam, which may leave it, of rates alone u̇ − Ṡ/sin λ = 0. */
  class ThreadFriction::Slip : public Evaluated<ThreadFriction::Slip, Constraint>
  {
  public:
    Slip(Layout                          &layout,
         const Item                      &joint,
         const std::vector<unsigned int> &coordinates,
         const std::vector<double>       &factors,
         const bool                       of_rates)
      : coordinates(coordinates)
      , factors(factors)
      , of_rates(of_rates)
      , multiplier(layout.add_multipliers(joint, {"slip of the thread"}))
    {
      layout.couple(block, {}, coordinates, {multiplier});
      if (of_rates)
        layout.nonholonomic.push_back(multiplier);
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      for (unsigned int i = 0; i < factors.size(); ++i)
        {
          r[block.row(i)] += factors[i] * point.multipliers[multiplier];
          if (!of_rates)
            r[block.row(factors.size())] += factors[i] * point.coordinates[coordinates[i]];
        }
    }

    void
    tangent(const Point<double> &, SparseMatrix &K) const override
    {
      for (unsigned int i = 0; i < factors.size(); ++i)
        {
          block.add_entry(i, factors.size(), factors[i], K);
          block.add_entry(factors.size(), i, factors[i], K);
        }
    }

    void
    rates(const Point<double> &point, double *rates) const override
    {
      rates[multiplier] = 0;
      for (unsigned int i = 0; i < factors.size(); ++i)
        rates[multiplier] += factors[i] * point.rates[coordinates[i]];
    }

    /** None: it is linear in the coordinates. */
    void
    second_rates(const Point<double> &, double *) const override
    {}

  private:
    const std::vector<unsigned int> coordinates; ///< u, d, θ, or u, S
    const std::vector<double>       factors;
    const bool                      of_rates;

  public:
    const unsigned int multiplier;

  private:
    Block block;
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
      return entries.refuse_unused(prm,
                                   "joint <" + joint.name + ">, thread",
                                   model.complaints,
                                   {"Radius", "Flank angle"});
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
    const double lead = std::atan2(std::abs(pitch), radius), sense = pitch < 0 ? -1 : 1;
    term = std::make_unique<Slip>(layout,
                                  joint,
                                  std::vector<unsigned int>{static_cast<unsigned int>(slip), displacement, rotation},
                                  std::vector<double>{1., -std::sin(lead), -sense * radius * std::cos(lead)},
                                  false);
    layout.add(joint, *term);
    add_friction(layout, joint, lead, {row});
  }



  void
  ThreadFriction::connect_nut(Layout            &layout,
                              const Item        &joint,
                              const unsigned int displacement,
                              const unsigned int row,
                              const double       turn)
  {
    terms.clear();
    if (slip < 0 || radius == 0)
      return;
    const double lead = std::atan2(1., std::abs(turn) * radius);
    auto         own  = std::make_unique<Slip>(layout,
                                      joint,
                                      std::vector<unsigned int>{static_cast<unsigned int>(slip), displacement},
                                      std::vector<double>{1., -1 / std::sin(lead)},
                                      true);
    layout.add(joint, *own);
    add_friction(layout, joint, lead, {row, own->multiplier});
    term = std::move(own);
  }



  Eigen::RowVector2d
  ThreadFriction::axial_force(const double turn) const
  {
    const double lead = std::atan2(1., std::abs(turn) * radius);
    return {-turn, std::abs(turn) * radius * std::cos(lead)};
  }



  void
  ThreadFriction::add_friction(Layout                          &layout,
                               const Item                      &joint,
                               const double                     lead,
                               const std::vector<unsigned int> &multipliers)
  {
    // the multipliers make the force along the axis: the law's coefficients that normal to the flanks
    const double tilt   = std::atan(std::tan(flank_angle) * std::cos(lead)),
                 normal = 1 / (std::cos(lead) * std::cos(tilt));
    Layout::Friction friction;
    friction.coordinates = {static_cast<unsigned int>(slip)};
    if (bristles >= 0)
      friction.states = {static_cast<unsigned int>(bristles)};
    friction.law = law;
    friction.law.kinetic *= normal;
    friction.law.breakaway *= normal;
    friction.preload     = entries.preload;
    friction.multipliers = multipliers;
    friction.name        = "joint " + joint.name + ", friction of the thread";
    terms.add_friction(layout, joint, friction);
  }
} // namespace samara
