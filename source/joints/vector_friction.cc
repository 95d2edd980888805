#include <samara/joints/vector_friction.h>

namespace samara
{
  /** Three unknowns whose rates are those of the turns of B against A, in axes of A: E_iᴬ·(ω_B − ω_A) − ṗ_i = 0. */
  class VectorFriction::Turns : public Evaluated<VectorFriction::Turns, Constraint>
  {
  public:
    Turns(Layout &layout, const Item &joint, const Frame &a, const Frame &b, const unsigned int first_coordinate)
      : a(a)
      , b(b)
      , coordinate(first_coordinate)
      , multiplier(layout.add_multipliers(joint, {"turn about axis 1", "turn about axis 2", "turn about axis 3"}))
    {
      const std::vector<unsigned int> three = {0, 1, 2};
      std::vector<unsigned int>       coordinates, multipliers;
      for (const unsigned int i : three)
        {
          coordinates.push_back(coordinate + i);
          multipliers.push_back(multiplier + i);
          layout.nonholonomic.push_back(multiplier + i);
        }
      layout.couple(block, {{a.node}, {b.node}}, coordinates, multipliers);
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      // moments λ_i about the axes of A
      const Number *const lambda = point.multipliers + multiplier;
      const Mat3<Number>  A      = a.triad(point.q);
      Vec3<Number>        moment;
      for (int i = 0; i < 3; ++i)
        moment(i) = A(i, 0) * lambda[0] + A(i, 1) * lambda[1] + A(i, 2) * lambda[2];
      const Vec3<Number> on_a = a.in_node(point.q_of_forces(), moment), on_b = b.in_node(point.q_of_forces(), moment);
      for (int i = 0; i < 3; ++i)
        {
          r[block.row(3 + i)] -= on_a(i);
          r[block.row(9 + i)] += on_b(i);
          r[block.row(12 + i)] -= lambda[i];
        }
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      const Eigen::Map<const Vector3> lambda(point.multipliers + multiplier);
      const Matrix3                   A = Frame{a.node}.triad(point.q), B = Frame{b.node}.triad(point.q);
      const Vector3                   moment = a.rotation * lambda, inertial = A * moment;
      // triads of stages are not orthonormal
      const Matrix3                 turn = skew(moment);
      Eigen::Matrix<double, 12, 12> H    = Eigen::Matrix<double, 12, 12>::Zero();
      H.block<3, 3>(3, 3)                = A.transpose() * A * turn - skew(Vector3(A.transpose() * inertial));
      H.block<3, 3>(9, 3)                = -B.transpose() * A * turn;
      H.block<3, 3>(9, 9)                = skew(Vector3(B.transpose() * inertial));
      block.add_twists(H, K);
      for (unsigned int i = 0; i < 3; ++i)
        {
          block.add_border(15 + i, coefficients(point, i), K);
          block.add_entry(12 + i, 15 + i, -1., K);
          block.add_entry(15 + i, 12 + i, -1., K);
        }
    }

    void
    rates(const Point<double> &point, double *rates) const override
    {
      const Eigen::Map<const Vector6> y_a(point.y + 6 * a.node), y_b(point.y + 6 * b.node);
      for (unsigned int i = 0; i < 3; ++i)
        {
          const auto c          = coefficients(point, i);
          rates[multiplier + i] = c.head<6>().dot(y_a) + c.tail<6>().dot(y_b) - point.rates[coordinate + i];
        }
    }

    void
    second_rates(const Point<double> &point, double *rates) const override
    {
      // Ė_iᴬ·(ω_B − ω_A): both angular velocities stay as they are
      const Eigen::Map<const Vector3> w_a(point.y + 6 * a.node + 3), w_b(point.y + 6 * b.node + 3);
      const Matrix3                   D_a = Frame{a.node}.triad(point.q), D_b = Frame{b.node}.triad(point.q);
      const Vector3                   slip = D_b * w_b - D_a * w_a;
      for (unsigned int i = 0; i < 3; ++i)
        rates[multiplier + i] = slip.dot(D_a * cross(Vector3(w_a), Vector3(a.rotation.col(i))));
    }

  private:
    const Frame        a, b;
    const unsigned int coordinate, multiplier;
    Block              block; ///< twists of both nodes, three coordinates, three multipliers

    /** Of the twists of the nodes in E_iᴬ·(ω_B − ω_A). */
    Eigen::Matrix<double, 12, 1>
    coefficients(const Point<double> &point, const unsigned int i) const
    {
      const Vector3                E = a.triad(point.q).col(i);
      Eigen::Matrix<double, 12, 1> c = Eigen::Matrix<double, 12, 1>::Zero();
      c.segment<3>(3)                = -a.in_node<double>(point.q, E);
      c.segment<3>(9)                = b.in_node<double>(point.q, E);
      return c;
    }
  };



  VectorFriction::VectorFriction(const Of of)
    : of(of)
  {}

  VectorFriction::~VectorFriction() = default;



  void
  VectorFriction::add_parameters(Parameters &joint)
  {
    has_entries = true;
    entries.add_parameters(joint.subsection(motion()), true, of == Of::ball);
  }



  void
  VectorFriction::initialize(Model                           &model,
                             const Item                      &joint,
                             const Parameters                &prm,
                             const std::vector<unsigned int> &displacements)
  {
    if (!is_given())
      return entries.refuse_unused(prm, "joint <" + joint.name + ">, " + motion(), model.complaints);
    law = entries.law(prm, "friction of the " + motion(), model.complaints);
    if (of == Of::ball && entries.radius == 0)
      model.complaints.add(prm.where("Friction"),
                           "joint <" + joint.name +
                             ">: the friction of the rotation needs a <Friction radius> above zero");
    coordinates = displacements;
    if (of == Of::ball)
      for (const std::string i : {"1", "2", "3"})
        coordinates.push_back(model.add_coordinate(joint.name + ".turn " + i, "rad"));
    bristles.clear();
    if (law.has_bristles())
      for (unsigned int i = 0; i < coordinates.size(); ++i)
        bristles.push_back(
          model.add_state(joint.name + "." + motion() + " bristles " + std::to_string(i + 1), "m", 0., 1.));
  }



  void
  VectorFriction::connect(Layout                          &layout,
                          const Item                      &joint,
                          const Frame                     &a,
                          const Frame                     &b,
                          const std::vector<unsigned int> &multipliers)
  {
    terms.clear();
    if (!is_given())
      return;
    if (of == Of::ball)
      {
        turns = std::make_unique<Turns>(layout, joint, a, b, coordinates.front());
        layout.add(joint, *turns);
      }
    add_to(layout, joint, multipliers);
  }



  void
  VectorFriction::connect(Layout                          &layout,
                          const Item                      &joint,
                          std::unique_ptr<Constraint>      rows,
                          const std::vector<unsigned int> &multipliers)
  {
    terms.clear();
    turns = std::move(rows);
    layout.add(joint, *turns);
    add_to(layout, joint, multipliers);
  }



  void
  VectorFriction::add_to(Layout &layout, const Item &joint, const std::vector<unsigned int> &multipliers)
  {
    Layout::Friction friction;
    friction.coordinates = coordinates;
    friction.states      = bristles;
    friction.arm         = of == Of::ball ? entries.radius : 1.;
    friction.law         = law;
    friction.preload     = entries.preload;
    friction.multipliers = multipliers;
    friction.name        = "joint " + joint.name + ", friction of the " + motion();
    terms.add_friction(layout, joint, friction);
  }
} // namespace samara
