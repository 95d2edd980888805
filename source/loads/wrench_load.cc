#include <samara/loads/loads.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  void
  WrenchLoad::add_axes_parameter(Parameters &prm)
  {
    prm.add("Axes",
            axes,
            "Axes of the components: inertial (a dead load) or body (a follower load).",
            dealii::Patterns::Selection("inertial|body"));
  }



  void
  WrenchLoad::be_placed(const Placement &placement)
  {
    for (const std::string entry : {"Force", "Moment"})
      parameters.turns(entry, is_follower() ? Turning::own_axes : Turning::direction);
    Item::be_placed(placement);
  }



  void
  WrenchLoad::add_part(const std::vector<Frame> &frames,
                       const Eigen::VectorXd    &weights,
                       const Eigen::MatrixXd    &products)
  {
    AssertDimension(frames.size(), weights.size());
    Assert(products.rows() == weights.size() && products.cols() == weights.size(),
           dealii::ExcDimensionMismatch(products.rows(), weights.size()));
    if (is_follower())
      spans.push_back({frames, products});
    else
      for (unsigned int a = 0; a < frames.size(); ++a)
        points.push_back({frames[a], weights(a)});
  }



  void
  WrenchLoad::find_signals(Model &model)
  {
    const auto find = [&](Responses &responses, const unsigned int first) {
      for (unsigned int i = first; i < first + 3; ++i)
        if (const Law &law = i < 3 ? force[i] : moment[i - 3]; law.depends_on_state())
          responses[i] = std::make_unique<Response>(law, model);
    };
    const auto any = [](const std::array<Law, 3> &laws) {
      return std::any_of(laws.begin(), laws.end(), [](const Law &law) { return law.depends_on_state(); });
    };
    depends_on_state = any(force) || any(moment);
    for (const bool is_force : {true, false})
      try
        {
          const unsigned int first = is_force ? 0 : 3;
          for (auto &load : points)
            find(load.responses, first);
          for (auto &span : spans)
            find(span.responses, first);
        }
      catch (const std::invalid_argument &problem)
        {
          model.complaints.add(parameters.where(is_force ? "Force" : "Moment"), problem.what());
        }
  }



  void
  WrenchLoad::connect(Layout &layout)
  {
    const auto connect_to = [&](const std::vector<Frame> &frames, Block &block, Responses &responses) {
      layout.couple(block, frames);
      for (auto &response : responses)
        if (response)
          response->connect(layout, {frames, {}, {}, {}});
    };
    for (auto &load : points)
      {
        load.frame = layout.model.resolved(load.frame);
        connect_to({load.frame}, load.block, load.responses);
      }
    for (auto &span : spans)
      {
        for (auto &frame : span.frames)
          frame = layout.model.resolved(frame);
        connect_to(span.frames, span.block, span.responses);
      }
    layout.add(*this, *this);
  }



  const WrenchLoad::Responses &
  WrenchLoad::responses() const
  {
    static const Responses none;
    return !points.empty() ? points[0].responses : !spans.empty() ? spans[0].responses : none;
  }



  template <typename Number>
  Vec6<Number>
  WrenchLoad::wrench(const Point<Number> &point) const
  {
    const Responses &of_state = responses();
    Vec6<Number>     result;
    for (unsigned int i = 0; i < 6; ++i)
      result(i) = point.factor * (of_state[i] ? (*of_state[i])(point) :
                                                Number((i < 3 ? force[i] : moment[i - 3]).of_time()(point.time)));
    return result;
  }



  template <typename Number>
  void
  WrenchLoad::local_residual(const AtPoint &load, const Vec6<Number> &wrench, const Number *q, Local<Number> &r) const
  {
    const Vec3<Number> f = -load.weight * wrench.template head<3>(), m = -load.weight * wrench.template tail<3>();
    r.resize(6);
    if (is_follower())
      r << f, m;
    else
      {
        const Mat3<Number> D = load.frame.triad(q);
        r << D.transpose() * f, D.transpose() * m;
      }
  }



  template <typename Number>
  void
  WrenchLoad::local_residual(const AlongSpan &span, const Vec6<Number> &wrench, const Number *q, Local<Number> &r) const
  {
    // D_aᵀ Σ_b W_ab D_b f, with the constant W_ab = ∫ N_a N_b p ds (doc/theory/element.md, line loads)
    r.resize(6 * span.frames.size());
    for (unsigned int a = 0; a < span.frames.size(); ++a)
      {
        Mat3<Number> d = Mat3<Number>::Zero(); // ∫ N_a p d ds
        for (unsigned int b = 0; b < span.frames.size(); ++b)
          d += span.products(a, b) * span.frames[b].triad(q);
        const Mat3<Number> seen = -span.frames[a].triad(q).transpose() * d;
        r.template segment<6>(6 * a) << seen * wrench.template head<3>(), seen * wrench.template tail<3>();
      }
  }



  template <typename Number>
  void
  WrenchLoad::residual_at(const Point<Number> &point, Number *r) const
  {
    // Block::add() changes it; memory is not asked for again
    static thread_local Local<Number> local;
    const Vec6<Number>                w   = wrench(point);
    const auto                        add = [&](const auto &parts) {
      for (const auto &part : parts)
        {
          local_residual(part, w, point.q, local);
          part.block.add(local, r);
        }
    };
    add(points);
    add(spans);
  }



  template <typename Part>
  void
  WrenchLoad::add_responses(const Part &part, const Point<double> &point, const bool by_velocity, SparseMatrix &A) const
  {
    Local<double> coefficients;
    for (unsigned int i = 0; i < 6; ++i)
      if (part.responses[i])
        {
          local_residual(part, Vector6(point.factor * Vector6::Unit(i)), point.q, coefficients);
          if (by_velocity)
            part.responses[i]->add_damping(point, coefficients, A);
          else
            part.responses[i]->add_tangent(point, coefficients, A);
        }
  }



  void
  WrenchLoad::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    static thread_local Eigen::MatrixXd local(6, 6);
    const Vector6                       w = wrench(point);
    for (const auto &span : spans)
      {
        add_tangent(span, w.head<3>(), w.tail<3>(), point.q, K);
        add_responses(span, point, false, K);
      }
    for (const auto &load : points)
      {
        if (!is_follower())
          {
            const Matrix3 D = load.frame.triad(point.q);
            local.setZero();
            local.topRightCorner<3, 3>()    = -load.weight * skew((D.transpose() * w.head<3>()).eval());
            local.bottomRightCorner<3, 3>() = -load.weight * skew((D.transpose() * w.tail<3>()).eval());
            load.block.add(local, K);
          }
        add_responses(load, point, false, K);
      }
  }



  void
  WrenchLoad::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (!depends_on_state)
      return;
    for (const auto &span : spans)
      add_responses(span, point, true, C);
    for (const auto &load : points)
      add_responses(load, point, true, C);
  }



  void
  WrenchLoad::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    for (const auto &response : responses())
      if (response)
        response->pieces(point, result);
  }



  void
  WrenchLoad::add_tangent(const AlongSpan &span, const Vector3 &f, const Vector3 &m, const double *q, SparseMatrix &K)
    const
  {
    // −δ(D_aᵀ W_ab D_b f) with δD = D θ~
    static thread_local Eigen::MatrixXd local;
    local.setZero(6 * span.frames.size(), 6 * span.frames.size());
    for (unsigned int a = 0; a < span.frames.size(); ++a)
      {
        const Matrix3 D_a = span.frames[a].triad(q);
        for (unsigned int b = 0; b < span.frames.size(); ++b)
          {
            const Matrix3 W = span.products(a, b) * D_a.transpose() * span.frames[b].triad(q);
            local.block<3, 3>(6 * a, 6 * b + 3) += W * skew(f);
            local.block<3, 3>(6 * a + 3, 6 * b + 3) += W * skew(m);
            local.block<3, 3>(6 * a, 6 * a + 3) -= skew((W * f).eval());
            local.block<3, 3>(6 * a + 3, 6 * a + 3) -= skew((W * m).eval());
          }
      }
    span.block.add(local, K);
  }



  double
  WrenchLoad::next_corner(const double from, const double to) const
  {
    return std::min(first_corner(force, from, to), first_corner(moment, from, to));
  }



  void
  ConcentratedLoad::add_parameters(Parameters &prm)
  {
    prm.add("At", at, "Where it acts: body.point.");
    prm.add("Force", force, "Components, expressions of time t and signals [N].");
    prm.add("Moment", moment, "Components, expressions of time t and signals [N*m].");
    add_axes_parameter(prm);
  }



  void
  ConcentratedLoad::initialize(Model &model)
  {
    try
      {
        if (parameters.require("At", model.complaints))
          points.push_back({model.frame(at), 1.});
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("At"), problem.what());
      }
  }



  template Vec6<double> WrenchLoad::wrench(const Point<double> &) const;
  template class Evaluated<WrenchLoad, Force>;
} // namespace samara
