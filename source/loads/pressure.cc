#include <samara/loads/surface_loads.h>

namespace samara
{
  void
  Pressure::add_parameters(Parameters &prm)
  {
    prm.add("Body", body, "Shell on which it acts.");
    prm.add("Region", region, "The part of it on which it acts: region skin, patch 2; not given: all of it.");
    prm.add("Pressure",
            pressure,
            "Force per deformed area along the normal, axis 3 of the shell; an expression of time t and signals [Pa].");
  }



  void
  Pressure::initialize(Model &model)
  {
    for (const auto &cell : cells_of(model, parameters, body, region))
      cells.push_back({cell});
    if (!cells.empty())
      loaded = &surface_body(model, body);
  }



  void
  Pressure::find_signals(Model &model)
  {
    if (!pressure.depends_on_state())
      return;
    try
      {
        for (auto &cell : cells)
          cell.response = std::make_unique<Response>(pressure, model);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("Pressure"), problem.what());
      }
  }



  void
  Pressure::connect(Layout &layout)
  {
    for (auto &cell : cells)
      {
        for (auto &frame : cell.surface.frames)
          frame = layout.model.resolved(frame);
        layout.couple(cell.block, cell.surface.frames);
        if (cell.response)
          cell.response->connect(layout, {cell.surface.frames, {}, {}, {}});
      }
    if (!cells.empty())
      layout.add(*this, *this);
  }



  template <typename Number>
  Number
  Pressure::value(const Point<Number> &point) const
  {
    const Response *const of_state = cells.front().response.get();
    return point.factor * (of_state != nullptr ? (*of_state)(point) : Number(pressure.of_time()(point.time)));
  }



  SurfaceTraction
  Pressure::traction(const Point<double> &point) const
  {
    SurfaceTraction result;
    result.pressure = value(point);
    return result;
  }



  template <typename Number>
  void
  Pressure::local_residual(const Cell                               &cell,
                           const Number                             &p,
                           const Number                             *q,
                           Eigen::Matrix<Number, Eigen::Dynamic, 1> &r) const
  {
    static thread_local std::vector<Vec3<Number>> x;
    const auto                                   &frames = cell.surface.frames;
    const SurfaceRule                            &rule   = *cell.surface.rule;
    x.clear();
    for (const auto &frame : frames)
      x.push_back(frame.position(q));
    r.setZero(6 * frames.size());
    for (unsigned int g = 0; g < rule.weights.size(); ++g)
      {
        // p x,₁ × x,₂: the normal times the deformed area, so that thinner or longer shells need no factor
        const Vec3<Number> f = rule.weights(g) * p * cell.surface.area_vector(g, x);
        for (unsigned int a = 0; a < frames.size(); ++a)
          r.template segment<3>(6 * a) -= rule.N(g, a) * f;
      }
    for (unsigned int a = 0; a < frames.size(); ++a)
      r.template segment<3>(6 * a) = (frames[a].triad(q).transpose() * r.template segment<3>(6 * a)).eval();
  }



  template <typename Number>
  void
  Pressure::residual_at(const Point<Number> &point, Number *r) const
  {
    static thread_local Eigen::Matrix<Number, Eigen::Dynamic, 1> local;
    const Number                                                 p = value(point);
    if (p == Number(0))
      return;
    for (const auto &cell : cells)
      {
        local_residual(cell, p, point.q, local);
        cell.block.add(local, r);
      }
  }



  void
  Pressure::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    add_responses(point, false, K);
    const double p = value(point);
    if (p == 0)
      return;
    Eigen::MatrixXd      local;
    std::vector<Vector3> x;
    std::vector<Matrix3> D;
    for (const auto &cell : cells)
      {
        const auto        &frames = cell.surface.frames;
        const SurfaceRule &rule   = *cell.surface.rule;
        const unsigned int n      = frames.size();
        x.clear();
        D.clear();
        for (const auto &frame : frames)
          {
            x.push_back(frame.position(point.q));
            D.push_back(frame.triad(point.q));
          }
        local.setZero(6 * n, 6 * n);
        std::vector<Vector3> force(n, Vector3::Zero());
        for (unsigned int g = 0; g < rule.weights.size(); ++g)
          {
            Vector3 x_1 = Vector3::Zero(), x_2 = Vector3::Zero();
            for (unsigned int a = 0; a < n; ++a)
              {
                x_1 += rule.dN_1(g, a) * x[a];
                x_2 += rule.dN_2(g, a) * x[a];
              }
            // δ(x,₁ × x,₂) = Σ_b (N_b,₂ x,₁~ − N_b,₁ x,₂~) D_b u_b
            const double  w   = rule.weights(g) * p;
            const Matrix3 s_1 = skew(x_1), s_2 = skew(x_2);
            for (unsigned int a = 0; a < n; ++a)
              force[a] += w * rule.N(g, a) * cross(x_1, x_2);
            for (unsigned int b = 0; b < n; ++b)
              {
                const Matrix3 change = (rule.dN_2(g, b) * s_1 - rule.dN_1(g, b) * s_2) * D[b];
                for (unsigned int a = 0; a < n; ++a)
                  local.block<3, 3>(6 * a, 6 * b) -= w * rule.N(g, a) * change;
              }
          }
        for (unsigned int a = 0; a < n; ++a)
          {
            local.middleRows<3>(6 * a) = (D[a].transpose() * local.middleRows<3>(6 * a)).eval();
            local.block<3, 3>(6 * a, 6 * a + 3) -= skew((D[a].transpose() * force[a]).eval());
          }
        cell.block.add(local, K);
      }
  }



  void
  Pressure::damping(const Point<double> &point, SparseMatrix &C) const
  {
    add_responses(point, true, C);
  }



  void
  Pressure::add_responses(const Point<double> &point, const bool by_velocity, SparseMatrix &A) const
  {
    Eigen::VectorXd coefficients;
    for (const auto &cell : cells)
      if (cell.response)
        {
          local_residual(cell, point.factor, point.q, coefficients);
          if (by_velocity)
            cell.response->add_damping(point, coefficients, A);
          else
            cell.response->add_tangent(point, coefficients, A);
        }
  }



  void
  Pressure::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    if (cells.front().response)
      cells.front().response->pieces(point, result);
  }



  double
  Pressure::next_corner(const double from, const double to) const
  {
    return pressure.next_corner(from, to);
  }



  template class Evaluated<Pressure, Force>;
} // namespace samara
