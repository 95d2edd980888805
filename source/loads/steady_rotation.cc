#include <samara/loads/loads.h>

namespace samara
{
  void
  SteadyRotation::add_parameters(Parameters &prm)
  {
    prm.add("Speed", rotation.speed, "Speed of rotation [rad/s].");
    prm.add("Joint",
            joint,
            "Joint whose rotation has this speed: a name, or name.rotation; empty: the whole model turns.");
    prm.add("Azimuth", azimuth, "Angle at which the joint is held in statics [rad].");
    prm.add("Axis", rotation.axis, "Axis about which the whole model turns, ground included [1].");
    prm.add("Through", rotation.through, "A point of this axis [m].");
    prm.turns("Axis", Turning::own_axes); // a rotation of the whole model is no part of a subsystem
    prm.turns("Through", Turning::own_axes);
  }



  void
  SteadyRotation::initialize(Model &m)
  {
    model         = &m;
    rotation.name = name;
    for (const std::string entry : {"Axis", "Through", "Azimuth"})
      if (parameters.is_set(entry) && joint.empty() == (entry == "Azimuth"))
        m.complaints.add(parameters.where(entry),
                         "steady rotation <" + name + "> turns " +
                           (joint.empty() ? "the whole model: there is no <Joint> to hold at" :
                                            "at the <Joint>, which says about which axis; leave out") +
                           " the <" + entry + ">");
    if (!joint.empty())
      try
        {
          rotation.coordinate = m.use_rotation(joint);
          for (const auto &other : m.rotations)
            if (other.coordinate == rotation.coordinate)
              throw std::invalid_argument("steady rotation <" + other.name + "> says already how <" + joint +
                                          "> turns");
        }
      catch (const std::invalid_argument &problem)
        {
          m.complaints.add(parameters.where("Joint"), problem.what());
        }
    else if (rotation.axis.isZero(0.))
      m.complaints.add(parameters.where("Axis"), "the axis must not be zero");
    m.rotations.push_back(rotation);
  }



  void
  SteadyRotation::connect(Layout &layout)
  {
    if (rotation.coordinate < 0)
      return;
    const auto prescribed = model->prescribed.find(rotation.coordinate);
    holding               = prescribed == model->prescribed.end();
    if (!holding)
      {
        if (parameters.is_set("Azimuth"))
          model->complaints.add(parameters.where("Azimuth"),
                                "the angle of <" + joint + "> is prescribed there; leave out the <Azimuth>");
        model->holds.push_back(prescribed->second);
        return;
      }
    multiplier = layout.add_multipliers(*this, {""});
    model->holds.push_back(multiplier);
    layout.couple(block, {}, {static_cast<unsigned int>(rotation.coordinate)}, {multiplier});
    layout.add(*this, *this);
  }



  template <typename Number>
  void
  SteadyRotation::residual_at(const Point<Number> &point, Number *r) const
  {
    const Number                             lambda = point.multipliers[multiplier];
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(2);
    if (point.held)
      local << lambda, point.coordinates[rotation.coordinate] - azimuth;
    else
      local << Number(0), lambda;
    block.add(local, r);
  }



  void
  SteadyRotation::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    Eigen::MatrixXd local(2, 2);
    if (point.held)
      local << 0, 1, 1, 0;
    else
      local << 0, 0, 0, 1;
    block.add(local, K);
  }



  template class Evaluated<SteadyRotation, Constraint>;
} // namespace samara
