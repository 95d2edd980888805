#include <samara/base/composite_rule.h>
#include <samara/base/text.h>
#include <samara/joints/distributing.h>
#include <samara/joints/moment_of.h>
#include <samara/model/surface.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /** M = −μ~, so that Σ_i μ_i (s_k·E_j − s_j·E_k) = Σ_jk M_jk E_j·s_k. */
    template <typename Number>
    Mat3<Number>
    pairing(const Number *multipliers)
    {
      return -skew(Vec3<Number>(multipliers[3], multipliers[4], multipliers[5]));
    }

    /** The matrix of θ → 2 axial(A θ~ M). */
    Matrix3
    turning(const Matrix3 &A, const Matrix3 &M)
    {
      Matrix3 result;
      for (int l = 0; l < 3; ++l)
        result.col(l) = moment_of<double>(A * skew(Vector3(Vector3::Unit(l))) * M);
      return result;
    }
  } // namespace



  void
  Distributing::add_parameters(Parameters &prm)
  {
    prm.add(
      "Along",
      edges,
      "Edges of shells, shell.edge u0, ..., or regions of them, shell.region pad, ..., whose mean motion is that of "
      "the body.");
    prm.add("Body", body, "Point of a body: body.point, or ground. It may be away from the edges; it then has an arm.");
  }



  void
  Distributing::initialize(Model &model)
  {
    // both are asked for, so that both are complained about
    const bool has_along = parameters.require("Along", model.complaints),
               has_body  = parameters.require("Body", model.complaints);
    if (!has_along || !has_body)
      return;
    std::string where = "Along";
    try
      {
        double  size     = 0;
        Vector3 centroid = Vector3::Zero();
        for (const auto &edge : edges)
          read_part(edge, model, size, centroid);
        centroid /= size;
        where = "Body";
        b     = model.frame_at(model.frame(body), centroid, Matrix3::Identity());
        for (auto &node : nodes)
          {
            node.place = model.position(node.frame) - centroid;
            node.frame = model.frame_at(node.frame, model.position(node.frame), Matrix3::Identity());
            node.weight /= size;
            node.of_axes *= 0.5 * node.weight;
          }
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(where), problem.what());
      }
  }



  void
  Distributing::read_part(const std::string &path, Model &model, double &size, Vector3 &centroid)
  {
    const auto        dot     = path.find('.');
    const std::string name    = trim(path.substr(0, dot));
    const auto *const surface = dynamic_cast<const SurfaceBody *>(&model.find<Body>(name, "body"));
    if (surface == nullptr)
      throw std::invalid_argument("body <" + name + "> has no edges; join it by a joint");
    const std::string part    = dot == std::string::npos ? "" : trim(path.substr(dot + 1));
    const double      h       = surface->thickness();
    const auto        regions = surface->regions();
    const bool        is_area = std::find(regions.begin(), regions.end(), part) != regions.end();
    if (!nodes.empty() && is_area != is_of_areas)
      throw std::invalid_argument("it is along edges, or over regions: lengths and areas have no common mean");
    is_of_areas = is_area;
    if (is_area)
      for (const auto &[frame, area] : surface->region(part))
        {
          size += area;
          centroid += area * model.position(frame);
          nodes.push_back({frame, area, Vector3::Zero(), h * h / 12});
        }
    else
      for (const auto &span : surface->edge(part))
        {
          const auto rule = composite_rule({span.start, span.end}, 10);
          for (unsigned int a = 0; a < span.frames.size(); ++a)
            {
              double weight = 0;
              for (const auto &[s, ds] : rule)
                weight += lagrange(span.abscissae, a, s) * ds;
              size += weight;
              centroid += weight * model.position(span.frames[a]);
              nodes.push_back({span.frames[a], weight, Vector3::Zero(), h * h / 12});
            }
        }
  }



  void
  Distributing::connect(Layout &layout)
  {
    if (nodes.empty())
      return;
    std::vector<std::string>  names;
    std::vector<unsigned int> multipliers;
    for (const std::string row : {"force 1", "force 2", "force 3", "moment 1", "moment 2", "moment 3"})
      names.push_back(row);
    first_multiplier = layout.add_multipliers(*this, names);
    for (unsigned int i = 0; i < 6; ++i)
      multipliers.push_back(first_multiplier + i);
    b = layout.model.resolved(b);
    layout.couple(block, {b}, {}, multipliers);
    for (auto &node : nodes)
      {
        node.frame = layout.model.resolved(node.frame);
        layout.couple(node.block, {node.frame, b}, {}, multipliers);
      }
    layout.add(*this, *this);
  }



  // s = Σ w x Xᵀ and a part of the thickness, X the place in the reference configuration: B has the mean rotation of
  // the nodes where Eᵀs is symmetric, E its axes (polar decomposition)
  template <typename Number>
  Mat3<Number>
  Distributing::moments(const Number *q) const
  {
    Mat3<Number> s = Mat3<Number>::Zero();
    for (const auto &node : nodes)
      s += node.weight * node.frame.position(q) * node.place.transpose() + node.of_axes * node.frame.triad(q);
    return s;
  }



  template <typename Number>
  void
  Distributing::residual_at(const Point<Number> &point, Number *r) const
  {
    // rows: Σ w x − x_B = 0, and E_j·s_k − E_k·s_j = 0 for (i, j, k) cyclic
    using Local                 = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    const Number *const lambdas = point.multipliers + first_multiplier;
    const Vec3<Number>  lambda(lambdas[0], lambdas[1], lambdas[2]);
    const Mat3<Number>  M = pairing(lambdas), E = b.triad(point.q), s = moments(point.q);
    const Mat3<Number>  E_of_forces = b.triad(point.q_of_forces());
    Vec3<Number>        gap = -b.position(point.q);
    Local               local;
    for (const auto &node : nodes)
      {
        const Mat3<Number> D = node.frame.triad(point.q_of_forces());
        gap += node.weight * node.frame.position(point.q);
        local.setZero(18);
        const Vec3<Number> force     = node.weight * (lambda + E * (M * node.place));
        local.template segment<3>(0) = D.transpose() * force;
        local.template segment<3>(3) = moment_of<Number>(node.of_axes * D.transpose() * E * M);
        node.block.add(local, r);
      }
    local.setZero(12);
    local.template segment<3>(0) = -E_of_forces.transpose() * lambda;
    local.template segment<3>(3) = moment_of<Number>(E_of_forces.transpose() * s * M.transpose());
    local.template segment<3>(6) = gap;
    for (int i = 0; i < 3; ++i)
      {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        local(9 + i) = dot(s.col(k), E.col(j)) - dot(s.col(j), E.col(k));
      }
    block.add(local, r);
  }



  void
  Distributing::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const double *const lambdas = point.multipliers + first_multiplier;
    const Vector3       lambda(lambdas[0], lambdas[1], lambdas[2]);
    const Matrix3       M = pairing(lambdas), E = b.triad(point.q), s = moments(point.q);
    Eigen::MatrixXd     local;
    const auto          unit = [](const int i) { return pairing(Vector6(Vector6::Unit(3 + i)).data()); };
    for (const auto &node : nodes)
      {
        const Matrix3 D = node.frame.triad(point.q), R = D.transpose() * E;
        const Vector3 y = M * node.place, force = node.weight * (D.transpose() * lambda + R * y);
        local.setZero(18, 18);
        local.block<3, 3>(0, 3)  = skew(force);
        local.block<3, 3>(0, 9)  = -node.weight * R * skew(y);
        local.block<3, 3>(9, 0)  = node.weight * skew(y) * R.transpose();
        const Matrix3 G          = node.of_axes * R * M;
        local.block<3, 3>(3, 3)  = G - G.trace() * Matrix3::Identity();
        local.block<3, 3>(3, 9)  = node.of_axes * turning(R, M);
        local.block<3, 3>(9, 3)  = node.of_axes * turning(R.transpose(), M.transpose());
        local.block<3, 3>(0, 12) = node.weight * D.transpose();
        for (int i = 0; i < 3; ++i)
          {
            local.block<3, 1>(0, 15 + i) = node.weight * R * (unit(i) * node.place);
            local.block<3, 1>(3, 15 + i) = moment_of<double>(node.of_axes * R * unit(i));
          }
        local.block<6, 6>(12, 0) = local.block<6, 6>(0, 12).transpose();
        node.block.add(local, K);
      }
    local.setZero(12, 12);
    const Matrix3 G         = E.transpose() * s * M.transpose();
    local.block<3, 3>(0, 3) = -skew((E.transpose() * lambda).eval());
    local.block<3, 3>(3, 3) = G - G.trace() * Matrix3::Identity();
    local.block<3, 3>(0, 6) = -E.transpose();
    for (int i = 0; i < 3; ++i)
      local.block<3, 1>(3, 9 + i) = moment_of<double>(E.transpose() * s * unit(i).transpose());
    local.block<6, 6>(6, 0) = local.block<6, 6>(0, 6).transpose();
    block.add(local, K);
  }



  void
  Distributing::rates(const Point<double> &point, double *rates) const
  {
    const Matrix3 E = b.triad(point.q), s = moments(point.q);
    const Vector6 y_b    = b.twist(point.y);
    Vector3       gap    = -E * y_b.head<3>();
    Matrix3       s_rate = Matrix3::Zero();
    for (const auto &node : nodes)
      {
        const Matrix3 D = node.frame.triad(point.q);
        const Vector6 y = node.frame.twist(point.y);
        const Vector3 v = D * y.head<3>();
        gap += node.weight * v;
        s_rate += node.weight * v * node.place.transpose() + node.of_axes * D * skew(Vector3(y.tail<3>()));
      }
    const Matrix3 E_rate = E * skew(Vector3(y_b.tail<3>()));
    for (int i = 0; i < 3; ++i)
      {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        rates[first_multiplier + i]     = gap(i);
        rates[first_multiplier + 3 + i] = s_rate.col(k).dot(E.col(j)) + s.col(k).dot(E_rate.col(j)) -
                                          s_rate.col(j).dot(E.col(k)) - s.col(j).dot(E_rate.col(k));
      }
  }



  void
  Distributing::second_rates(const Point<double> &point, double *rates) const
  {
    // ẍ = D ω~v, Ḋ = D ω~, D̈ = D ω~ω~
    const Matrix3 E = b.triad(point.q), s = moments(point.q);
    const Vector6 y_b    = b.twist(point.y);
    const Matrix3 spin_b = skew(Vector3(y_b.tail<3>())), E_rate = E * spin_b, E_second = E_rate * spin_b;
    Vector3       gap    = -E_rate * y_b.head<3>();
    Matrix3       s_rate = Matrix3::Zero(), s_second = Matrix3::Zero();
    for (const auto &node : nodes)
      {
        const Matrix3 D    = node.frame.triad(point.q);
        const Vector6 y    = node.frame.twist(point.y);
        const Matrix3 spin = skew(Vector3(y.tail<3>())), D_rate = D * spin;
        const Vector3 v = D * y.head<3>(), change = D_rate * y.head<3>();
        gap += node.weight * change;
        s_rate += node.weight * v * node.place.transpose() + node.of_axes * D_rate;
        s_second += node.weight * change * node.place.transpose() + node.of_axes * D_rate * spin;
      }
    const auto product = [&](const int j, const int k) {
      return s_second.col(k).dot(E.col(j)) + 2 * s_rate.col(k).dot(E_rate.col(j)) + s.col(k).dot(E_second.col(j));
    };
    for (int i = 0; i < 3; ++i)
      {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        rates[first_multiplier + i]     = gap(i);
        rates[first_multiplier + 3 + i] = product(j, k) - product(k, j);
      }
  }



  std::optional<Probe>
  Distributing::probe(const std::string &path) const
  {
    for (int i = 0; i < 3; ++i)
      {
        if (path == "force " + std::to_string(i + 1))
          return Probe{path, "N", [this, i](const State &state) { return state.multipliers[first_multiplier + i]; }};
        if (path == "moment " + std::to_string(i + 1))
          return Probe{path, "N m", [this, i](const State &state) {
                         const Matrix3 E = b.triad(state.q.data()), s = moments(state.q.data());
                         const Matrix3 M = pairing(&state.multipliers[first_multiplier]);
                         return -(E * moment_of<double>(E.transpose() * s * M.transpose()))(i);
                       }};
      }
    return {};
  }



  std::vector<std::string>
  Distributing::probe_names() const
  {
    return {"force 1", "force 2", "force 3", "moment 1", "moment 2", "moment 3"};
  }



  template class Evaluated<Distributing, Constraint>;
} // namespace samara
