#include <samara/joints/partial_joints.h>

#include <cmath>
#include <stdexcept>

namespace samara
{
  void
  InLine::add_parameters(Parameters &prm)
  {
    lock_displacement(0);
    lock_displacement(1);
    free_displacement(2);
    Joint::add_parameters(prm);
    ball.add_parameters(prm);
  }



  void
  InLine::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    Joint::add_relative_rates(q, rates);
    add_turns(q, rates);
  }



  void
  InPlane::add_parameters(Parameters &prm)
  {
    lock_displacement(2);
    free_displacement(0, "displacement 1");
    free_displacement(1, "displacement 2");
    Joint::add_parameters(prm);
    plane.add_parameters(prm);
    ball.add_parameters(prm);
  }



  void
  InPlane::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    Joint::add_relative_rates(q, rates);
    add_turns(q, rates);
  }



  void
  ConstantVelocity::add_parameters(Parameters &prm)
  {
    for (const unsigned int i : {0, 1, 2})
      lock_displacement(i);
    lock_twist();
    Joint::add_parameters(prm);
    ball.add_parameters(prm);
    prm.add("Second axis",
            second_axis,
            "Direction of the shaft on body B in the reference configuration; 0, 0, 0: that of Axis [1].");
    prm.turns("Second axis", Turning::direction);
  }



  void
  ConstantVelocity::be_moved(const MotionOf &motion_of)
  {
    const Vector3 drawn = second_axis.isZero(0.) ? axis : second_axis;
    Joint::be_moved(motion_of);
    parameters.assign("Second axis", Vector3(motion_of(body_b).rotation * drawn));
  }



  void
  ConstantVelocity::place(Model &model, const Frame &a, const Frame &b)
  {
    Joint::place(model, a, b);
    if (second_axis.isZero(0.))
      return;
    const Matrix3 E      = axes();
    const Vector3 second = second_axis.normalized();
    if (E.col(2).dot(second) < -0.999)
      throw std::invalid_argument("the two shafts point against each other; turn the <Second axis> round");
    frame_b = model.frame_at(b,
                             model.position(frame_b),
                             Eigen::Quaterniond::FromTwoVectors(E.col(2), second).toRotationMatrix() * E);
  }



  void
  ConstantVelocity::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    constexpr double         least_bend = 1e-9;
    const PairValues<double> pair(frame_a, frame_b, q);
    const Vector3            a = pair.A.col(2), b = frame_b.triad(q).col(2), normal = a.cross(b);
    if (normal.norm() < least_bend)
      {
        add_turns(q, rates);
        rates.pop_back(); // with the twist that is locked, two rates say all
        return;
      }
    // bend, and turning of its plane: these axes turn with neither body, and stand still while the shafts turn
    const Vector3 bend = normal.normalized(), whirl = bend.cross(a + b).normalized();
    for (const auto &[motion, e] : {std::make_pair(".bend", bend), std::make_pair(".turning of the bend", whirl)})
      {
        RelativeRate rate;
        rate.name           = name + motion;
        rate.a              = frame_a.node;
        rate.b              = frame_b.node;
        rate.on_a.tail<3>() = -frame_a.in_node<double>(q, e);
        rate.on_b.tail<3>() = frame_b.in_node<double>(q, e);
        rates.push_back(rate);
      }
  }



  void
  ConstantVelocity::add_pressing(std::vector<unsigned int> &multipliers) const
  {
    for (unsigned int i = 0; i < locked.size(); ++i)
      multipliers.push_back(first_multiplier + i); // three forces, and the twist
  }



  bool
  ConstantVelocity::presses(const Layout::Friction &friction) const
  {
    return friction.multipliers.front() == first_multiplier;
  }



  PressingParts<double>
  ConstantVelocity::pressing_parts(const Layout::Friction &friction, const Point<double> &) const
  {
    PressingParts<double> parts;
    parts.add(4).leftCols<3>().setIdentity();
    parts.add(4)(0, 3) = 2 / friction.arm;
    return parts;
  }



  PressingParts<std::complex<double>>
  ConstantVelocity::pressing_parts(const Layout::Friction &friction, const Point<std::complex<double>> &) const
  {
    const auto                          real = pressing_parts(friction, Point<double>());
    PressingParts<std::complex<double>> parts;
    for (unsigned int p = 0; p < real.n; ++p)
      parts.add(4) = real.of[p].cast<std::complex<double>>();
    return parts;
  }



  Matrix3
  SkewUniversal::axes() const
  {
    return triad(axis, second_axis); // throws if they are parallel
  }



  void
  SkewUniversal::place(Model &model, const Frame &a, const Frame &b)
  {
    Joint::place(model, a, b);
    // axis 2 of B is the second axis itself; axis 3 is that of A
    const Matrix3 E = axes();
    Matrix3       F;
    F.col(1) = second_axis.normalized();
    F.col(2) = E.col(2);
    F.col(0) = F.col(1).cross(F.col(2));
    frame_b  = model.frame_at(b, model.position(frame_b), F);

    const double cosine = E.col(0).dot(F.col(1));
    for (auto &l : locked)
      if (l.function.kind == PairFunction::cosine)
        {
          l.value = cosine;
          l.sign *= std::sqrt(1 - cosine * cosine); // the multiplier acts about E₁ᴬ × E₂ᴮ, which is not of unit length
        }
  }
} // namespace samara
