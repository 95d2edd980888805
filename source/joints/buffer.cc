#include <samara/base/text.h>
#include <samara/joints/buffer.h>
#include <samara/model/probe_needs.h>

#include <cmath>

namespace samara
{
  void
  Buffer::add_parameters(Parameters &prm)
  {
    prm.add("Joint A", joint_a, "Sliding joint: a name.");
    prm.add("Joint B", joint_b, "Another one, on the same beam.");
    prm.add("Length",
            length,
            "How far apart along the beam the two are when they touch: between the frames that slide [m].",
            dealii::Patterns::Double(0));
    contact.add_parameters(prm, "", false);
  }



  void
  Buffer::complain(Model &m, const std::string &entry, const std::string &text) const
  {
    m.complaints.add(parameters.where(entry), "buffer <" + name + ">: " + text);
  }



  bool
  Buffer::find_joints(Model &m)
  {
    bool are_known = true;
    for (const unsigned int i : {0, 1})
      {
        const std::string entry = i == 0 ? "Joint A" : "Joint B";
        try
          {
            if (!parameters.require(entry, m.complaints))
              {
                are_known = false;
                continue;
              }
            auto &joint = m.find<SlidingJoint>(i == 0 ? joint_a : joint_b, "sliding joint");
            joints[i]   = &joint;
            if (joint.may_leave())
              throw std::invalid_argument("<" + joint.name +
                                          "> may leave its beam, and a buffer would go on holding it there");
            coordinates[i] = joint.use_coordinate(m, "displacement").value();
          }
        catch (const std::invalid_argument &problem)
          {
            m.complaints.add(parameters.where(entry), problem.what());
            are_known = false;
          }
      }
    if (are_known && joints[0] == joints[1])
      {
        complain(m, "Joint B", "it needs two joints, not one twice");
        return false;
      }
    return are_known;
  }



  void
  Buffer::initialize(Model &m)
  {
    model = &m;
    if (!contact.is_given())
      complain(m, "Joint A", "it needs a <Stiffness> above zero");
    law = contact.law(parameters, "", "buffer <" + name + ">", m.complaints);
    if (find_joints(m))
      coordinates[2] = m.add_coordinate(name + ".gap", "m");
  }



  void
  Buffer::connect(Layout &layout)
  {
    // both joints know where they are by now, whatever their order in the file
    if (joints[0]->beam() != joints[1]->beam())
      return complain(*model,
                      "Joint B",
                      "<" + joint_a + "> and <" + joint_b + "> slide on different beams: they do not meet");
    const double apart = joints[1]->start_abscissa() - joints[0]->start_abscissa();
    order              = apart < 0 ? -1. : 1.;
    gap                = std::abs(apart) - length;
    if (std::abs(gap) < 1e-9 * std::abs(apart))
      gap = 0; // drawn to touch
    if (apart == 0)
      return complain(*model, "Joint B", "<" + joint_a + "> and <" + joint_b + "> are at one place: in which order?");
    if (gap < 0)
      return complain(*model,
                      "Length",
                      "<" + joint_a + "> and <" + joint_b + "> are " + number_to_text("%.6g", std::abs(apart)) +
                        " m apart along the beam in the reference configuration, less than its <Length>");
    multiplier = layout.add_multipliers(*this, {""});
    layout.couple(block, {}, {coordinates.begin(), coordinates.end()}, {multiplier});
    layout.add(*this, *this);
    stop.clear();
    stop.add_stop(layout, *this, {coordinates[2], -gap, -1., law, true, "buffer " + name + ", contact"});
  }



  // the gap is a coordinate of its own, tied to the two abscissae by a linear constraint: the stop acts on it alone
  template <typename Number>
  void
  Buffer::residual_at(const Point<Number> &point, Number *const r) const
  {
    const auto slope = slopes();
    for (unsigned int i = 0; i < 3; ++i)
      {
        r[block.row(i)] += slope[i] * point.multipliers[multiplier];
        r[block.row(3)] += slope[i] * point.coordinates[coordinates[i]];
      }
  }



  void
  Buffer::tangent(const Point<double> &, SparseMatrix &K) const
  {
    const auto slope = slopes();
    for (unsigned int i = 0; i < 3; ++i)
      {
        block.add_entry(i, 3, slope[i], K);
        block.add_entry(3, i, slope[i], K);
      }
  }



  void
  Buffer::rates(const Point<double> &point, double *const rates) const
  {
    const auto slope  = slopes();
    rates[multiplier] = 0;
    for (unsigned int i = 0; i < 3; ++i)
      rates[multiplier] += slope[i] * point.rates[coordinates[i]];
  }



  std::optional<Probe>
  Buffer::probe(const std::string &path) const
  {
    if (path == "gap")
      return Probe{path, "m", OfPlaces{[this](const State &state) { return gap + state.coordinates[coordinates[2]]; }}};
    if (path == "gap rate")
      return Probe{path, "m/s", OfVelocities{{[this](const State &state) { return state.rates[coordinates[2]]; }}}};
    if (path == "force")
      return Probe{path, "N", [this](const State &state) { return -state.multipliers[multiplier]; }};
    return {};
  }



  std::vector<std::string>
  Buffer::probe_names() const
  {
    return {"gap", "gap rate", "force"};
  }



  template class Evaluated<Buffer, Constraint>;
} // namespace samara
