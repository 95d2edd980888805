#include <samara/base/text.h>
#include <samara/cosserat/beam.h>
#include <samara/model/frame_probe.h>
#include <samara/rotation/matrix6.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/hp/fe_collection.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  Beam::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Shape", shape, "How the reference line is given.", Selection("polyline|arc|expressions"));
    prm.add("Points", corner_points, "Corners of a polyline, or start, middle and end of an arc: x, y, z; ... [m].");
    prm.add("Expressions", expressions, "x, y, z of the reference line as functions of s from 0 to 1 [m].");
    prm.add("Axis 2", axis_2, "Direction near which section axis 2 lies at the start; 0, 0, 0: horizontal [1].");
    prm.add("Twist", twist, "Initial rotation of the section about axis 1, as a function of the arc length s [rad].");
    prm.add(
      "Elements",
      elements_wish,
      "Number of elements along the beam, which end at corners, frames and, if there are enough of them, where section "
      "or twist have kinks (not given: as many as that takes, at least 4); if there are not, and equal elements miss more than "
      "1e-3 of the section, at those within a third of an element from their ends. Or <automatic, 1e-4>: elements and their degrees so that the strains of the equilibrium, or "
      "of the modes without loads, have this relative error in the energy norm, as estimated.");
    prm.add("Degree",
            degree,
            "Polynomial degree p of an element, 1 to 6; displacements converge with order 2p.",
            Integer(1, highest_beam_degree));
    prm.add(
      "Mesh",
      mesh_texts,
      "Elements one by one, in place of the two entries above: degree to relative abscissa, ..., 3 to 0.25, 2 to 1.");
    prm.add("Section", section_name, "Name of the section.");
    prm.add("Frames", frame_names, "Points others can attach to: name at relative abscissa, name at ...");
    prm.add("Rigid",
            rigid,
            "Whether the beam is a rigid body with the mass of its sections; it then adds a single node.");
    prm.add(
      "Damping",
      viscosity,
      "Stiffness-proportional damping: viscous stress is this time times the rate of elastic stress; one number, or six "
      "for Gamma1 Gamma2 Gamma3 K1 K2 K3 [s].",
      List(Double(0), 1, 6));
    prm.add("Damping ratio",
            damping_ratio,
            "The same given as the damping ratio of a mode at the frequency below; one number or six [1].",
            List(Double(0), 1, 6));
    prm.add("Damping frequency", damping_frequency, "Frequency at which the damping ratio holds [rad/s].", Double(0));
    initial_velocity.add_parameters(prm, "start of the beam");
    initial_fields.add_parameters(prm);
    prm.turns("Points", Turning::position);
    prm.turns("Expressions", Turning::position);
    prm.turns("Axis 2", Turning::direction);
  }



  void
  Beam::be_placed(const Placement &placement)
  {
    // the axis that is chosen where none is given is horizontal in the axes of the subsystem
    if (axis_2.isZero(0.) && make_curve().empty())
      parameters.assign("Axis 2", Vector3(curve->triad(0., 0.).col(1)));
    Item::be_placed(placement);
  }



  void
  Beam::initialize(Model &model_)
  {
    model             = &model_;
    const auto before = model->complaints.count();
    try
      {
        if (parameters.require("Section", model->complaints))
          section = &model->find<Section>(section_name, "section");
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where("Section"), problem.what());
      }
    for (const auto *entry : {&viscosity, &damping_ratio})
      if (entry->size() != 1 && entry->size() != 6)
        model->complaints.add(parameters.where(entry == &viscosity ? "Damping" : "Damping ratio"),
                              "give one number or six, for Gamma1 Gamma2 Gamma3 K1 K2 K3");
    if (damping_ratio != std::vector<double>(damping_ratio.size(), 0.) && damping_frequency == 0)
      model->complaints.add(parameters.where("Damping ratio"),
                            "a damping ratio needs the <Damping frequency> it holds at");
    if (!find_curve() || section == nullptr || model->complaints.count() != before)
      return;
    try
      {
        if (section->has_twist() && parameters.is_set("Twist"))
          throw std::invalid_argument("it has a column <twist>, and the beam a <Twist>: leave out one");
        section = &section->along(curve->length());
        make_cells();
        if (model->complaints.count() == before)
          make_nodes_and_elements();
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where("Section"),
                              "section <" + section_name + "> in beam <" + name + ">: " + problem.what());
      }
  }



  std::string
  Beam::make_curve()
  {
    try
      {
        curve = shape == "arc"         ? make_arc(corner_points, axis_2) :
                shape == "expressions" ? make_expression_curve(expressions, axis_2) :
                                         make_polyline(corner_points, axis_2);
        return "";
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
  }



  bool
  Beam::find_curve()
  {
    const std::string fault = make_curve();
    if (!fault.empty())
      model->complaints.add(parameters.where(shape == "expressions" ? "Expressions" : "Points"), fault);
    return fault.empty();
  }



  Matrix3
  Beam::triad_at(const double s, const double inside) const
  {
    const Matrix3 D     = curve->triad(s, inside);
    double        angle = section->twist(s / curve->length(), inside / curve->length());
    if (!twist.is_zero())
      {
        const double here = twist(s), beside = twist(s + 1e-9 * (inside - s));
        angle += std::abs(beside - here) > least_jump_of_twist ? beside : here;
      }
    return angle == 0 ? D : D * rotation_of_vector({angle, 0, 0});
  }



  namespace
  {
    /** Numbers of the nodes of each cell in the order of ElementTable; cells of these degrees share those at @p ends.
     */
    std::vector<std::vector<dealii::types::global_dof_index>>
    dofs_of_cells(const std::vector<dealii::Point<3>> &ends, const std::vector<unsigned int> &degrees)
    {
      AssertDimension(ends.size(), degrees.size() + 1);
      std::vector<dealii::CellData<1>> cell_data(degrees.size());
      for (unsigned int i = 0; i < degrees.size(); ++i)
        cell_data[i].vertices = {i, i + 1};
      dealii::Triangulation<1, 3> triangulation;
      triangulation.create_triangulation(ends, cell_data, {});
      dealii::DoFHandler<1, 3>       dof_handler(triangulation);
      dealii::hp::FECollection<1, 3> elements_by_degree;
      for (unsigned int p = 1; p <= *std::max_element(degrees.begin(), degrees.end()); ++p)
        elements_by_degree.push_back(dealii::FE_Q<1, 3>(p));
      for (const auto &cell : dof_handler.active_cell_iterators())
        cell->set_active_fe_index(degrees[cell->active_cell_index()] - 1);
      dof_handler.distribute_dofs(elements_by_degree);

      std::vector<std::vector<dealii::types::global_dof_index>> result(degrees.size());
      for (const auto &cell : dof_handler.active_cell_iterators())
        {
          auto &dofs = result[cell->active_cell_index()];
          dofs.resize(degrees[cell->active_cell_index()] + 1);
          cell->get_dof_indices(dofs);
        }
      return result;
    }



    /** Add the inertia of an element to its nodes: @p inertias are per length, at the nodes. */
    void
    lump_inertia(const ElementTable<1>      &table,
                 const std::vector<Frame>   &frames,
                 const std::vector<Matrix6> &inertias,
                 Model                      &model)
    {
      for (unsigned int a = 0; a < table.n_nodes; ++a)
        {
          Vector3 dx = Vector3::Zero();
          for (unsigned int b = 0; b < table.n_nodes; ++b)
            dx += table.gradient_at_nodes[0](a, b) * model.position(frames[b]);
          model.add_inertia(frames[a], table.node_weights(a) * dx.norm() * inertias[a]);
        }
    }



    dealii::Point<3>
    point_of(const Vector3 &x)
    {
      return {x(0), x(1), x(2)};
    }
  } // namespace



  void
  Beam::make_nodes_and_elements()
  {
    std::vector<dealii::Point<3>> ends;
    std::vector<unsigned int>     degrees;
    ends.push_back(point_of(curve->position(0)));
    for (const Cell &c : cells)
      {
        const double h = c.end - c.start, size = std::max(curve->length(), ends.back().norm());
        if (h < 1e-9 * size)
          {
            model->complaints.add(
              parameters.where(shape == "expressions" ? "Expressions" : "Points"),
              "beam <" + name + "> has an element of " + number_to_text("%.3g", h) + " m at numbers of " +
                number_to_text("%.3g", size) +
                " m: its strains would lose their digits. Put the origin near it; is a unit wrong?");
            return;
          }
        degrees.push_back(c.degree);
        ends.push_back(point_of(curve->position(c.end)));
      }

    // nodes are numbered along the beam, in the order of the cells
    const auto                                                     dofs = dofs_of_cells(ends, degrees);
    std::map<dealii::types::global_dof_index, unsigned int>        node_of_dof;
    std::map<unsigned int, std::shared_ptr<const ElementTable<1>>> tables;
    for (unsigned int i = 0; i < cells.size(); ++i)
      {
        const Cell &c = cells[i];
        auto       &t = tables[c.degree];
        if (t == nullptr)
          t = std::make_shared<ElementTable<1>>(c.degree);
        table               = t;
        const double middle = 0.5 * (c.start + c.end);

        std::vector<Frame> frames(table->n_nodes);
        for (unsigned int a = 0; a < table->n_nodes; ++a)
          {
            const double  s           = c.start + table->nodes[a][0] * (c.end - c.start);
            const Matrix3 D           = triad_at(s, middle);
            const auto [node, is_new] = node_of_dof.emplace(dofs[i][a], node_frames.size());
            if (is_new)
              {
                node_frames.push_back(model->add_node(name, curve->position(s), D));
                node_abscissae.push_back(s);
              }
            frames[a] = node_frames[node->second];
            // beyond a corner the section's axes are turned against those of the shared node
            const Matrix3 Q = model->triad(frames[a]).transpose() * D;
            if ((Q - Matrix3::Identity()).norm() > 1e-13)
              frames[a] = frames[a].then(Vector3::Zero(), Q);
          }

        lump_inertia(*table, frames, inertias_of(c), *model);
        add_element(*model, frames, materials_of_cell(c));
      }
    if (!rigid)
      return;
    make_rigid();
    for (const auto &frame : node_frames)
      model->weld(node_frames[0], frame);
  }



  void
  Beam::connect(Layout &layout)
  {
    Cosserat<1>::connect(layout);
    if (n_elements() > 0 && has_trapeze())
      {
        tension_torsion = std::make_unique<TensionTorsion>(*this, trapezes);
        layout.add(*this, *tension_torsion);
      }
    for (auto &frame : node_frames)
      frame = model->resolved(frame);
    if (node_frames.empty())
      return;
    initial_velocity.check(node_frames, *this, model->complaints);
    initial_fields.check(node_frames, node_abscissae, *this, model->complaints);
  }



  void
  Beam::add_strain_products(std::vector<StrainProduct> &products) const
  {
    if (tension_torsion != nullptr)
      tension_torsion->add_products(products);
  }



  std::vector<unsigned int>
  Beam::rigid_nodes() const
  {
    std::vector<unsigned int> nodes;
    for (const auto &frame : node_frames)
      nodes.push_back(frame.node);
    return nodes;
  }



  void
  Beam::add_initial_velocities(State &state) const
  {
    initial_velocity.assign(node_frames, *this, state);
  }



  std::vector<Vector3>
  Beam::tangents(const State &state) const
  {
    // the line has turned with its sections since the reference configuration, but for shear
    std::vector<Vector3> result;
    for (const auto &frame : node_frames)
      result.push_back(frame.triad(state.q.data()).col(0));
    return result;
  }



  void
  Beam::add_velocity_fields(const State &state, std::map<unsigned int, Vector6> &twists) const
  {
    initial_fields.add_twists(node_frames, node_abscissae, tangents(state), *this, state, twists);
  }



  void
  Beam::add_displacement_fields(const State &state, std::map<unsigned int, Place> &places) const
  {
    initial_fields.add_places(node_frames, node_abscissae, tangents(state), *this, state, places);
  }



  std::optional<double>
  Beam::abscissa_of(const std::string &point) const
  {
    if (named.count(point) == 1)
      return named.at(point);
    if (point.substr(0, 3) != "at ")
      return {};
    double x = 0;
    if (!text_to_number(trim(point.substr(3)), x) || x < 0 || x > 1)
      throw std::invalid_argument("there is no <" + point + "> on beam <" + name +
                                  ">; write <at x> with x from 0 (start) to 1 (end)");
    return curve == nullptr ? 0. : x * curve->length();
  }



  int
  Beam::node_at(const double s) const
  {
    for (unsigned int i = 0; i < node_abscissae.size(); ++i)
      if (std::abs(node_abscissae[i] - s) < 1e-9 * curve->length())
        return i;
    return -1;
  }



  Frame
  Beam::frame(const std::string &point) const
  {
    const auto s = abscissa_of(point);
    if (!s)
      throw std::invalid_argument("beam <" + name + "> has no point <" + point + ">" + did_you_mean(point, points()));
    if (node_frames.empty())
      return {}; // the beam itself could not be made; it has complained already
    const int node = node_at(*s);
    if (node < 0)
      throw std::invalid_argument("beam <" + name + "> has no node at <" + point +
                                  ">; name this place in <Frames>, so that an element ends there");
    return node_frames[node];
  }



  std::vector<std::string>
  Beam::points() const
  {
    std::vector<std::string> names;
    for (const auto &point : named)
      names.push_back(point.first);
    return names;
  }



  std::vector<Span>
  Beam::spans() const
  {
    std::vector<Span> result;
    for (unsigned int i = 0; i < elements.size(); ++i)
      {
        result.push_back({elements[i].frames, {}, cells[i].start, cells[i].end});
        for (const auto &node : elements[i].table->nodes)
          result.back().abscissae.push_back(cells[i].start + node[0] * (cells[i].end - cells[i].start));
      }
    return result;
  }



  std::vector<Eigen::MatrixXd>
  Beam::legendre_coefficients(const double *e) const
  {
    std::vector<Eigen::MatrixXd> result;
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        const ElementTable<1> &t = *elements[i].table;
        const double           h = cells[i].end - cells[i].start;
        const Matrix6          C = section_at(cells[i], 0.5 * (cells[i].start + cells[i].end)).stiffness;
        Eigen::MatrixXd        a = Eigen::MatrixXd::Zero(6, t.n_points);
        for (unsigned int k = 0; k < t.n_points; ++k)
          {
            const dealii::Polynomials::Legendre L(k); // orthonormal on (0, 1)
            for (unsigned int g = 0; g < t.n_points; ++g)
              a.col(k) += t.weights(g) * L.value(t.points[g][0]) *
                          Eigen::Map<const Vector6>(e + 6 * (elements[i].first_point + g));
          }
        result.push_back(cholesky_upper(C) * (std::sqrt(h) * a));
      }
    return result;
  }



  double
  Beam::geometry_error(const double start, const double end, const unsigned int p) const
  {
    const double                                                L = curve->length(), middle = 0.5 * (start + end) * L;
    static thread_local std::map<unsigned int, ElementTable<1>> tables;
    const ElementTable<1>                                      &t = tables.try_emplace(p, p).first->second;
    const auto s_of    = [&](const dealii::Point<1> &xi) { return L * (start + xi[0] * (end - start)); };
    double     largest = 0;
    for (unsigned int g = 0; g < t.n_points; ++g)
      {
        Matrix3 D = Matrix3::Zero();
        for (unsigned int a = 0; a < t.n_nodes; ++a)
          D += t.N(g, a) * triad_at(s_of(t.nodes[a]), middle);
        largest = std::max(largest, (D - triad_at(s_of(t.points[g]), middle)).norm());
      }
    return largest;
  }
} // namespace samara
