#include <samara/base/dense.h>
#include <samara/base/text.h>
#include <samara/cosserat/imported_mesh.h>
#include <samara/cosserat/shell.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/laminate.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  void
  Shell::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Patches",
            patch_entries,
            "x, y, z of each patch of the reference surface as functions of u and v from 0 to 1: x, y, z; x, y, z; ... "
            "[m].");
    prm.add(
      "Elements",
      elements_entry,
      "Numbers of elements along u and v; one pair for all patches, or a pair for each: 4, 8; 2, 8; or <automatic, "
      "1e-2>, <automatic, 1e-2 from 4, 8; 2, 8>: as many, beginning with these, that the strains of the equilibrium, "
      "or of the modes without loads, have this relative error in the energy norm, as estimated.");
    prm.add("Mesh",
            mesh_entries,
            "Instead of <Elements>: where they end along u by along v, of each patch: 0.25 0.5 1 by 0.5 1; ...");
    prm.add("Merge", merges, "Whether nodes at one place are one; not given: of patches, not of a mesh file.");
    prm.add("Grid",
            grid,
            "Instead of patches: a function of deal.II's GridGenerator that makes a surface in space, hyper_sphere, "
            "torus.");
    prm.add("Grid arguments", grid_arguments, "Its arguments, separated by colons: 0, 0, 0 : 1; plain SI numbers.");
    prm.add("Refinements", refinements, "How often each cell of a grid or mesh file is cut into four.", Integer(0, 10));
    prm.add_file(
      "Mesh file",
      mesh_file,
      "Instead of patches: a mesh of Gmsh (.msh, text) or Abaqus (.inp) with quadrilaterals of four corners; in "
      "metres; relative to the .prm file that says it.");
    prm.add(
      "Curved",
      is_curved,
      "Whether cells of a mesh file are curved between the normals at their corners, or as flat as they are given.");
    prm.add("Degree",
            degree,
            "Polynomial degree p of an element, 1 to 6; 1 only on parallelograms. 3 or 4 for curved thin shells.",
            Integer(1, 6));
    prm.add("Crease angle",
            crease,
            "Cells whose normals differ by less at a node have one normal there, averaged; more is a corner [rad].",
            Double(0, M_PI));
    prm.add(
      "Axis 1",
      axis_1,
      "Direction whose projection on the surface is axis 1; 0, 0, 0: x, or without a layup the next that is not nearly normal [1].");
    add_material_parameters(prm);
    prm.add("Frames",
            frame_entries,
            "Points others can attach to, where the mesh has a node: name at u v (on the first patch), name at x y z "
            "(inertial coordinates, plain numbers in metres), name at point NAME (of a mesh file), ...");
    prm.add(
      "Rigid edges",
      rigid_edges,
      "Edges, or regions, that are kept as stiff as a rigid body, each with a name for a frame at its centre with "
      "inertial axes, to which others can attach: root at edge u0, pad at region pad, ...");
    prm.add(
      "Curves",
      curve_entries,
      "Curves along which something may slide, as <Body A = shell.name>: name at u, v; name of patch 2 at u, v; ... "
      "u and v as functions of s from 0 to 1 that stay on the patch.");
    prm.add("Rigid", rigid, "Whether the shell is a rigid body with its mass; it then adds a single node.");
    initial_velocity.add_parameters(prm, "first node of the mesh");
  }



  std::vector<Remark>
  Shell::remarks() const
  {
    if (of_coincident.empty())
      return {};
    return {{Remark::line, "shell " + name + ": " + of_coincident}};
  }



  void
  Shell::be_placed(const Placement &)
  {
    throw std::invalid_argument(
      "shell <" + name + "> cannot stand in a subsystem that is turned or moved; write its patches where they are");
  }



  void
  Shell::initialize(Model &model_)
  {
    model             = &model_;
    const auto before = model->complaints.count();
    make_laminates();
    if (!make_mesh() || laminates.empty() || model->complaints.count() != before)
      return;
    distribute_laminates();
    if (model->complaints.count() != before)
      return;
    make_rule();
    for (const auto &laminate : laminates)
      compliances.push_back(positive_inverse(laminate.ABD));
    make_nodes_and_elements();
    if (model->complaints.count() != before)
      return;
    name_points();
    make_rigid_edges();
    check_curves();
    if (!rigid)
      return;
    make_rigid();
    for (const auto &frame : node_frames)
      model->weld(node_frames[0], frame);
  }



  std::string
  Shell::complaint_about_elements() const
  {
    const std::size_t n_patches = patch_entries.size(), n_counts = elements_entry.counts.size();
    if (n_patches > 0 && n_counts != 1 && n_counts != n_patches)
      return "give one pair of numbers of elements, or one for each of the " + std::to_string(n_patches) + " patches";
    if (!mesh_entries.empty() && mesh_entries.size() != n_patches)
      return "give a mesh for each of the " + std::to_string(n_patches) + " patches";
    if (wanted_error() > 0 && takes_any_cell)
      return "only shells of type <shell> find their elements automatically";
    if (wanted_error() > 0 && degree > 5)
      return "automatic elements have degrees up to 5, for they are compared with those of one degree more";
    return "";
  }



  PatchMesh
  Shell::mesh_of_patch(const unsigned int patch) const
  {
    if (!mesh_entries.empty())
      return mesh_entries[patch];
    const auto         &counts = elements_entry.counts;
    const PatchElements n      = counts[counts.size() == 1 ? 0 : patch];
    PatchMesh           result{Division(n.u), Division(n.v)};
    // nodes of all degrees at points with names, as far as that is a matter of one patch
    if (wanted_error() > 0 && patch_entries.size() == 1)
      for (const auto &text : frame_entries)
        {
          std::string        name_of_point, place;
          double             u = 0, v = 0;
          std::istringstream words(split_at(text, name_of_point, place) ? place : "");
          std::string        rest;
          if (words >> u >> v && !(words >> rest) && std::min(u, v) >= 0 && std::max(u, v) <= 1)
            {
              result.u.add(u);
              result.v.add(v);
            }
        }
    return result;
  }



  bool
  Shell::make_mesh()
  {
    const bool        has_patches = !patch_entries.empty();
    const std::string given       = has_patches ? "Patches" : !grid.empty() ? "Grid" : "Mesh file";
    if (has_patches + !grid.empty() + !mesh_file.empty() != 1)
      {
        model->complaints.add(parameters.where(given),
                              "shell <" + name + "> needs either <Patches>, or a <Grid>, or a <Mesh file>");
        return false;
      }
    if (const std::string problem = complaint_about_elements(); !problem.empty())
      {
        model->complaints.add(parameters.where(mesh_entries.empty() ? "Elements" : "Mesh"), problem);
        return false;
      }
    table                = std::make_shared<ElementTable<2>>(degree);
    mesh                 = std::make_unique<ShellMesh>(*table);
    mesh->takes_any_cell = takes_any_cell;
    try
      {
        for (unsigned int i = 0; i < patch_entries.size(); ++i)
          mesh->add_patch({patch_entries[i], mesh_of_patch(i)});
        if (!grid.empty())
          mesh->add_grid(grid, grid_arguments, refinements);
        if (!mesh_file.empty())
          {
            ImportedMesh file = read_mesh_file(mesh_file);
            of_coincident     = file.take_coincident(merges && parameters.is_set("Merge"), mesh_file);
            groups_of_file    = " " + mesh_file + " has " + file.groups() + ".";
            mesh->add_cells(file, is_curved, crease, refinements);
          }
        if (has_patches && merges)
          mesh->merge();
        mesh->finish(merges && has_patches);
        return true;
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where(given), "shell <" + name + ">: " + problem.what());
        return false;
      }
  }



  void
  Shell::make_rule()
  {
    const dealii::FE_Q<2>   fe(degree);
    const dealii::QGauss<2> gauss(degree + 1);
    auto                    made = std::make_shared<SurfaceRule>();
    const unsigned int      n_q = gauss.size(), n_nodes = table->n_nodes;
    made->N.resize(n_q, n_nodes);
    made->dN_1.resize(n_q, n_nodes);
    made->dN_2.resize(n_q, n_nodes);
    made->weights = Eigen::Map<const Eigen::VectorXd>(gauss.get_weights().data(), n_q);
    for (unsigned int g = 0; g < n_q; ++g)
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          made->N(g, a)    = fe.shape_value(a, gauss.point(g));
          made->dN_1(g, a) = fe.shape_grad(a, gauss.point(g))[0];
          made->dN_2(g, a) = fe.shape_grad(a, gauss.point(g))[1];
        }
    rule = made;
    // as many points of integration as nodes: what is known at the points is interpolated to the nodes
    to_nodes = inverse(made->N);
    make_rule_across();
    make_samples();
  }



  std::vector<std::vector<Vector3>>
  Shell::normals() const
  {
    struct At
    {
      unsigned int cell, a;
      Vector3      area;
    };
    std::vector<std::vector<At>> at_node(mesh->nodes.size());
    for (unsigned int i = 0; i < mesh->cells.size(); ++i)
      for (unsigned int a = 0; a < table->n_nodes; ++a)
        {
          const auto g = mesh->tangents(mesh->cells[i], a);
          at_node[mesh->cells[i].nodes[a]].push_back({i, a, cross(g[0], g[1])});
        }
    std::vector<std::vector<Vector3>> result(mesh->cells.size(), std::vector<Vector3>(table->n_nodes));
    for (const auto &cells : at_node)
      {
        // groups of cells that are near each other, directly or through others between them
        std::vector<int> group(cells.size(), -1);
        for (unsigned int seed = 0; seed < cells.size(); ++seed)
          {
            if (group[seed] >= 0)
              continue;
            std::vector<unsigned int> members(1, seed);
            group[seed] = seed;
            for (unsigned int k = 0; k < members.size(); ++k)
              for (unsigned int j = 0; j < cells.size(); ++j)
                if (const Vector3 &n = cells[members[k]].area, &m = cells[j].area;
                    group[j] < 0 && std::atan2(cross(n, m).norm(), n.dot(m)) <= crease)
                  {
                    group[j] = seed;
                    members.push_back(j);
                  }
            Vector3 sum = Vector3::Zero();
            for (const auto j : members)
              sum += cells[j].area.normalized();
            for (const auto j : members)
              result[cells[j].cell][cells[j].a] = sum.normalized();
          }
      }
    return result;
  }



  std::vector<Matrix3>
  Shell::triads(const unsigned int cell, const std::vector<Vector3> &normals) const
  {
    const auto in_plane = [](const Vector3 &e, const Vector3 &n) { return Vector3(e - n * n.dot(e)); };
    const auto shortest = [&](const Vector3 &e) {
      double length = 1;
      for (const auto &n : normals)
        length = std::min(length, in_plane(e, n).norm());
      return length;
    };
    Vector3 e = axis_1.isZero(0.) ? Vector3(Vector3::UnitX()) : Vector3(axis_1.normalized());
    if (axis_1.isZero(0.) && layup_name.empty() && patch_layups.empty() &&
        region_layups.empty()) // of an isotropic shell any axis will do
      for (const auto &other : {Vector3(Vector3::UnitY()), Vector3(Vector3::UnitZ())})
        if (shortest(e) < 0.5 && shortest(other) > shortest(e))
          e = other;
    if (shortest(e) < 0.05)
      throw std::invalid_argument("<Axis 1> is normal to the surface in " + mesh->name_of(cell));
    std::vector<Matrix3> result;
    for (const auto &n : normals)
      {
        Matrix3 D;
        D.col(0) = in_plane(e, n).normalized();
        D.col(1) = cross(n, D.col(0));
        D.col(2) = n;
        result.push_back(D);
      }
    // around a point where it is normal they turn once, and between the nodes they would shrink to nothing
    for (unsigned int g = 0; g < table->n_points; ++g)
      {
        Matrix3 D = Matrix3::Zero();
        for (unsigned int a = 0; a < table->n_nodes; ++a)
          D += table->value_at_points(g, a) * result[a];
        if (D.col(0).norm() < 0.9 * D.col(2).norm())
          throw std::invalid_argument("<Axis 1> turns too far about the normal in " + mesh->name_of(cell) +
                                      ": somewhere near it is normal to the surface. Take another one, or smaller "
                                      "cells, or patches with a hole there");
      }
    return result;
  }



  void
  Shell::make_nodes_and_elements()
  {
    const auto           all_normals = normals();
    std::vector<Matrix6> inertias;
    for (const auto &laminate : laminates)
      inertias.push_back(inertia(laminate));
    node_frames.resize(mesh->nodes.size());
    node_axes.resize(mesh->nodes.size());
    std::vector<bool> is_made(mesh->nodes.size(), false);
    try
      {
        for (unsigned int i = 0; i < mesh->cells.size(); ++i)
          {
            const auto        &nodes    = mesh->cells[i].nodes;
            const auto         axes     = triads(i, all_normals[i]);
            const unsigned int laminate = laminate_of(i);
            std::vector<Frame> frames;
            for (unsigned int a = 0; a < table->n_nodes; ++a)
              {
                if (!is_made[nodes[a]])
                  {
                    node_frames[nodes[a]] = model->add_node(name, mesh->nodes[nodes[a]], axes[a]);
                    node_axes[nodes[a]]   = axes[a];
                    is_made[nodes[a]]     = true;
                  }
                // the node's axes are those of the first cell; those of others are turned against them
                Frame         frame = node_frames[nodes[a]];
                const Matrix3 Q     = model->triad(frame).transpose() * axes[a];
                if ((Q - Matrix3::Identity()).norm() > 1e-13)
                  frame = frame.then(Vector3::Zero(), Q);
                frames.push_back(frame);
                const auto g = mesh->tangents(mesh->cells[i], a);
                model->add_inertia(frame, table->node_weights(a) * cross(g[0], g[1]).norm() * inertias[laminate]);
              }
            add_element(*model, frames, std::vector<unsigned int>(table->n_points, material_of(i)));
          }
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where("Axis 1"), "shell <" + name + ">: " + problem.what());
      }
  }



  void
  Shell::name_points()
  {
    for (const auto &text : frame_entries)
      {
        std::string point, place;
        try
          {
            if (!split_at(text, point, place) || point.empty())
              throw std::invalid_argument("a frame is written <name at u v> or <name at x y z>, not <" + text + ">");
            if (!named.insert({point, point_of(node_at(place))}).second)
              throw std::invalid_argument("shell <" + name + "> has a point <" + point + "> already");
          }
        catch (const std::invalid_argument &problem)
          {
            model->complaints.add(parameters.where("Frames"), problem.what());
          }
      }
  }



  void
  Shell::make_rigid_edges()
  {
    for (const auto &text : rigid_edges)
      {
        std::string point, place;
        try
          {
            if (!split_at(text, point, place) || point.empty())
              throw std::invalid_argument("a rigid edge is written <name at edge u0>, not <" + text + ">");
            make_rigid_edge(point, place);
          }
        catch (const std::invalid_argument &problem)
          {
            model->complaints.add(parameters.where("Rigid edges"), problem.what());
          }
      }
  }



  void
  Shell::make_rigid_edge(const std::string &point, const std::string &place)
  {
    if (mesh->regions.count(place) == 0)
      edge(place); // that it is there
    double      size   = 0;
    Vector3     centre = Vector3::Zero();
    const auto  shares = mesh->shares_of(place);
    const Frame first  = node_frames[shares.begin()->first];
    for (const auto &[node, share] : shares)
      {
        size += share;
        centre += share * mesh->nodes[node];
        model->weld(first, node_frames[node]);
      }
    centre /= size;
    const Frame centred = model->frame_at(first, centre, Matrix3::Identity());
    if (!named.insert({point, {centred, centre, Matrix3::Identity(), -1}}).second)
      throw std::invalid_argument("shell <" + name + "> has a point <" + point + "> already");
  }



  void
  Shell::connect(Layout &layout)
  {
    Cosserat<2>::connect(layout);
    find_loads_on_surface();
    for (auto &frame : node_frames)
      frame = layout.model.resolved(frame);
    for (auto &point : named)
      point.second.frame = layout.model.resolved(point.second.frame);
    if (!node_frames.empty())
      initial_velocity.check(node_frames, *this, model->complaints);
  }



  std::vector<unsigned int>
  Shell::rigid_nodes() const
  {
    std::vector<unsigned int> nodes;
    for (const auto &frame : node_frames)
      nodes.push_back(frame.node);
    return nodes;
  }



  void
  Shell::add_initial_velocities(State &state) const
  {
    initial_velocity.assign(node_frames, *this, state);
  }
} // namespace samara
