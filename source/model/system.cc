#include <samara/model/strain_rows.h>
#include <samara/model/system.h>
#include <samara/model/virtual_mass.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  System::System(Model &model)
    : model(model)
    , layout(model)
    , has_viscous(std::any_of(layout.deformations.begin(),
                              layout.deformations.end(),
                              [](const auto *d) { return d->is_viscous(); }))
    , deformations(layout.deformations)
  {
    for (const auto *d : layout.deformations)
      if (std::find(deformations.begin(), deformations.end(), d) != deformations.end())
        if (auto together = d->joined(deformations))
          joined_deformations.push_back(std::move(together));
    for (const auto &together : joined_deformations)
      deformations.push_back(together.get());
  }



  namespace
  {
    /** Whether a state belongs to the system of this layout. */
    [[maybe_unused]] bool
    fits(const State &state, const Layout &layout)
    {
      return state.q.size() == 12 * layout.n_nodes && state.y.size() == 6 * layout.n_nodes &&
             state.coordinates.size() == layout.n_coordinates && state.states.size() == layout.n_states &&
             state.state_rates.size() == layout.n_states && state.rates.size() == layout.n_coordinates &&
             state.multipliers.size() == layout.n_multipliers && state.stress.size() == layout.n_strains;
    }

    DeclExceptionMsg(ExcOtherSystem, "The state is not one of this system: its sizes are others.");
    DeclExceptionMsg(ExcOtherPattern, "The matrix does not have the pattern of the system.");
  } // namespace



  State
  System::reference() const
  {
    State state;
    for (const auto &node : model.nodes)
      {
        state.q.insert(state.q.end(), node.x.data(), node.x.data() + 3);
        state.q.insert(state.q.end(), node.D.data(), node.D.data() + 9);
      }
    state.coordinates.assign(layout.n_coordinates, 0.);
    state.rates.assign(layout.n_coordinates, 0.);
    for (const auto &z : model.states)
      state.states.push_back(z.initial);
    state.state_rates.assign(layout.n_states, 0.);
    state.y.assign(6 * layout.n_nodes, 0.);
    state.multipliers.assign(layout.n_multipliers, 0.);
    state.stress.assign(layout.n_strains, 0.);
    state.motion.resize(layout.n_nodes);
    state.left_out = dropped;
    return state;
  }



  void
  System::strains(const State &state, std::vector<double> &e) const
  {
    e.resize(layout.n_strains);
    strains(state.point(), e.data());
  }



  void
  System::stresses(const State &state, std::vector<double> &stress) const
  {
    thread_local std::vector<double> e;
    strains(state, e);
    stresses(state, e, stress);
  }



  void
  System::stresses(const State &state, const std::vector<double> &e, std::vector<double> &stress) const
  {
    thread_local std::vector<double> rates;
    rates.assign(layout.n_strains, 0.);
    stress.resize(layout.n_strains);
    if (has_viscous)
      strain_rates(state.point(), rates.data());
    stresses(e.data(), rates.data(), stress.data());
  }



  void
  System::residual(const State &state, const std::vector<double> &stress, std::vector<double> &r) const
  {
    Assert(fits(state, layout), ExcOtherSystem());
    AssertDimension(stress.size(), layout.n_strains);
    r.assign(size() + 6, 0.);
    Point<double> point = state.point();
    point.stress        = stress.data();
    add_terms(point, r.data());
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        // column by column: the compiler keeps the sum in registers, which it does not with Eigen's product
        const Matrix6      &M = model.nodes[node].inertia;
        const double *const y = &state.y[6 * node];
        Vector6             p = y[0] * M.col(0);
        for (int j = 1; j < 6; ++j)
          p += y[j] * M.col(j);
        // −ad*_y p = (ω × l, ω × a + v × l) of the momenta l, a
        double *const       force = &r[layout.of_node(node)];
        const double *const w     = y + 3;
        for (int i = 0; i < 3; ++i)
          {
            const int m = (i + 1) % 3, n = (i + 2) % 3;
            force[i] += w[m] * p[n] - w[n] * p[m];
            force[3 + i] += w[m] * p[3 + n] - w[n] * p[3 + m] + y[m] * p[n] - y[n] * p[m];
          }
      }
    for (const auto i : state.left_out)
      r[layout.of_multiplier(i)] = state.multipliers[i];
  }



  std::vector<unsigned int>
  System::released_multipliers() const
  {
    // an angle that is prescribed stays so
    std::vector<unsigned int> released;
    for (const auto hold : model.holds)
      if (std::none_of(model.prescribed.begin(), model.prescribed.end(), [&](const auto &p) {
            return p.second == hold;
          }))
        released.push_back(hold);
    return released;
  }



  void
  System::drop(const std::vector<unsigned int> &multipliers)
  {
    dropped = multipliers;
  }



  namespace
  {
    /** Add a 6×6 matrix to the diagonal block of each node. */
    template <typename MatrixOfNode>
    void
    add_nodal(const Layout &layout, SparseMatrix &A, const MatrixOfNode &matrix_of_node)
    {
      for (unsigned int node = 1; node < layout.n_nodes; ++node)
        {
          const Matrix6 block = matrix_of_node(node);
          const int     first = layout.of_node(node);
          for (int j = 0; j < 6; ++j)
            {
              // the six rows of a node stand side by side in each of its columns
              const int position = A.pattern->position(first, first + j);
              for (int i = 0; i < 6; ++i)
                A.values[position + i] += block(i, j);
            }
        }
    }
  } // namespace



  void
  System::tangent(const State &state, SparseMatrix &K, const bool with_material) const
  {
    Assert(fits(state, layout), ExcOtherSystem());
    Assert(K.pattern == layout.pattern, ExcOtherPattern());
    K.clear();
    Point<double> point = state.point();
    point.material      = with_material;
    add_tangent(point, K);
    if (std::any_of(state.y.begin(), state.y.end(), [](const double v) { return v != 0.; }))
      add_nodal(layout, K, [&](const unsigned int node) -> Matrix6 {
        const Eigen::Map<const Vector6> y(&state.y[6 * node]);
        return gyroscopic_tangent(model.nodes[node].inertia, y) * ad(y);
      });
    fix_left_out(state.left_out, K);
  }



  void
  System::fix_left_out(const std::vector<unsigned int> &left_out, SparseMatrix &K) const
  {
    for (const auto i : left_out)
      {
        const int j = layout.of_multiplier(i);
        for (int k = K.pattern->column_start[j]; k < K.pattern->column_start[j + 1]; ++k)
          K.values[k] = K.values[K.pattern->position(j, K.pattern->rows[k])] = 0.;
        K.values[K.pattern->position(j, j)] = 1.;
      }
  }



  void
  System::damping(const State &state, SparseMatrix &C, const bool with_material) const
  {
    Assert(fits(state, layout), ExcOtherSystem());
    Assert(C.pattern == layout.pattern, ExcOtherPattern());
    C.clear();
    Point<double> point = state.point();
    point.material      = with_material;
    add_damping(point, C);
    add_state_damping(C);
    add_nodal(layout, C, [&](const unsigned int node) -> Matrix6 {
      const Eigen::Map<const Vector6> y(&state.y[6 * node]);
      const Matrix6                  &M = model.nodes[node].inertia;
      return M * ad(y) + gyroscopic_tangent(M, y);
    });
  }



  void
  System::mass(SparseMatrix &M) const
  {
    Assert(M.pattern == layout.pattern, ExcOtherPattern());
    M.clear();
    add_nodal(layout, M, [&](const unsigned int node) -> Matrix6 { return model.nodes[node].inertia; });
  }



  void
  System::update(State &state, const std::vector<double> &z) const
  {
    Assert(fits(state, layout), ExcOtherSystem());
    Assert(z.size() >= size(), dealii::ExcDimensionMismatch(z.size(), size()));
    // the stress first, while the state is still the one that was linearised about
    thread_local std::vector<double> e, rates, linear_strain, twists;
    strains(state, e);
    rates.assign(layout.n_strains, 0.);
    linear_strain.assign(layout.n_strains, 0.);
    twists.assign(6 * layout.n_nodes, 0.);
    std::copy_n(z.begin(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
    Point<double> point = state.point();
    if (has_viscous)
      strain_rates(point, rates.data());
    point.y     = twists.data();
    point.rates = z.data() + layout.of_coordinate(0);
    strain_rates(point, linear_strain.data());
    for (unsigned int i = 0; i < layout.n_strains; ++i)
      e[i] += linear_strain[i];
    stresses(e.data(), rates.data(), state.stress.data());

    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const double *const zn = &z[layout.of_node(node)];
        Eigen::Map<Vector3> x(&state.q[12 * node]);
        Eigen::Map<Matrix3> D(&state.q[12 * node + 3]);
        x += D * Eigen::Map<const Vector3>(zn);
        D = renormalised(D * cayley<double>(Eigen::Map<const Vector3>(zn + 3)));
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        const double change = z[layout.of_coordinate(i)];
        state.coordinates[i] += model.coordinate_units[i] == "rad" ? 2 * std::atan(0.5 * change) : change;
      }
    for (const auto *c : layout.constraints)
      c->follow_angles(state);
    for (unsigned int i = 0; i < layout.n_states; ++i)
      state.states[i] += z[layout.of_state(i)];
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      state.multipliers[i] += z[layout.of_multiplier(i)];
    update_twists(state);
  }



  void
  System::update_twists(State &state) const
  {
    for (unsigned int node = 0; node < layout.n_nodes; ++node)
      {
        const auto   &m = state.motion[node];
        const Matrix3 D = state.triad(node);
        Eigen::Map<Vector6>(&state.y[6 * node])
          << D.transpose() * (m.velocity + m.spin.cross(state.position(node) - m.at)),
          D.transpose() * m.spin;
      }
  }



  System::Energy
  System::energy(const State &state) const
  {
    thread_local std::vector<double> e;
    strains(state, e);
    return energy(state, e);
  }



  System::Energy
  System::energy(const State &state, const std::vector<double> &e) const
  {
    Energy energy{0, strain_energy(e.data())};
    for (unsigned int node = 0; node < layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector6> y(&state.y[6 * node]);
        energy.kinetic += 0.5 * y.dot(model.nodes[node].inertia * y);
      }
    return energy;
  }



  System::MassProperties
  System::mass_properties(const State &state) const
  {
    // the inertia of everything seen at the origin, [m I, −m c~; m c~, J]
    Matrix6    total          = Matrix6::Zero();
    const auto without_weight = virtual_mass(model);
    for (unsigned int node = 0; node < layout.n_nodes; ++node)
      {
        // a node is a frame at its place with its axes in a body at the origin
        const Matrix6 S = twist_transfer(state.position(node), state.triad(node));
        Matrix6       M = model.nodes[node].inertia;
        if (!without_weight.empty())
          M -= without_weight[node];
        total += S.transpose() * M * S;
      }
    const double  mass   = total.topLeftCorner<3, 3>().trace() / 3;
    const Vector3 centre = mass > 0 ? Vector3(axial(total.bottomLeftCorner<3, 3>()) / mass) : Vector3::Zero();
    return {mass, centre, total.bottomRightCorner<3, 3>() + mass * skew(centre) * skew(centre)};
  }
} // namespace samara
