#include <samara/analysis/check.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/static.h>
#include <samara/cosserat/beam.h>
#include <samara/input/input.h>
#include <samara/study/automatic_mesh.h>
#include <samara/study/automatic_shells.h>

#include <deal.II/fe/fe_series.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace samara
{
  namespace
  {
    constexpr unsigned int highest_degree = 4, most_passes = 60, most_elements = 2000, most_cells = 10'000;

    struct BeamMesh
    {
      double                   wanted; ///< relative error
      std::vector<MeshElement> elements;

      double
      start(const unsigned int i) const
      {
        return i == 0 ? 0. : elements[i - 1].end;
      }
    };

    using Meshes = std::map<std::string, BeamMesh>;
    /** How well an element resolves what it has to. */
    struct Indicator
    {
      double error = 0; ///< square, in the energy norm
      double decay = 0; ///< σ in |a_k| ∝ exp(−σ k)
    };

    using Indicators = std::map<std::string, std::vector<Indicator>>;



    std::vector<const Beam *>
    beams_of(const Model &model)
    {
      std::vector<const Beam *> beams;
      for (const auto &c : model.items)
        if (const auto *const beam = dynamic_cast<const Beam *>(c.get()))
          beams.push_back(beam);
      return beams;
    }



    Meshes
    first_meshes(const Model &model)
    {
      Meshes meshes;
      for (const auto *const beam : beams_of(model))
        if (beam->wanted_error() > 0)
          meshes[beam->name] = {beam->wanted_error(), beam->mesh()};
      return meshes;
    }



    std::vector<std::string>
    with_meshes(std::vector<std::string> overrides,
                const Meshes            &meshes,
                const ShellMeshes       &shells,
                const unsigned int       higher)
    {
      shells.add_overrides(higher, overrides);
      for (const auto &[name, mesh] : meshes)
        {
          auto elements = mesh.elements;
          for (auto &element : elements)
            element.degree += higher;
          overrides.push_back("Bodies/" + name + "/Mesh = " + mesh_to_text(elements));
        }
      return overrides;
    }



    /** So that those of another mesh are among these modes, though their order may differ. */
    std::vector<std::string>
    with_more_modes(std::vector<std::string> overrides, const unsigned int n_modes)
    {
      constexpr unsigned int more = 4;
      for (const std::string entry : {"Analyses = static, modal", "Modal/Animations = 0"})
        overrides.push_back(entry);
      overrides.push_back("Modal/Modes = " + std::to_string(n_modes + more));
      return overrides;
    }



    template <typename Kind>
    Kind &
    analysis_of(Input &input, const bool only_if_asked_for, bool &is_there)
    {
      for (const auto &a : input.analyses)
        if (auto *const wanted = dynamic_cast<Kind *>(a.get()))
          {
            is_there = true;
            return *wanted;
          }
      is_there = !only_if_asked_for;
      input.analyses.push_back(std::make_unique<Kind>());
      return static_cast<Kind &>(*input.analyses.back());
    }



    /** Strains of the whole model that the mesh has to resolve: of the equilibrium and of the modes. */
    class Solution
    {
    public:
      Solution(const Catalogue                &catalogue,
               const InputFile                &file,
               const std::vector<std::string> &overrides,
               const bool                      with_modes)
        : input(catalogue, file, overrides)
        , system(input.model)
        , log(stream)
        , context{system, log, "", {}, false, system.reference(), {}, {}}
      {
        input.use_settings();
        system.drop(check_model(system).redundant_multipliers);
        context.state = system.reference();
        for (const auto &rotation : input.model.rotations)
          context.speeds.push_back(rotation.speed);

        is_static     = is_loaded();
        bool is_there = false;
        if (is_static)
          {
            auto &statics = analysis_of<StaticAnalysis>(input, false, is_there);
            statics.start(context);
            statics.run(context);
            strains.emplace_back();
            system.strains(context.state, strains.back());
          }
        auto &modal = analysis_of<ModalAnalysis>(input, is_static, is_there);
        if (!is_there || !with_modes)
          return;
        modal.run(context);
        n_modes = modal.modes.size();
        for (const auto &mode : modal.modes)
          for (const bool imaginary : {false, true})
            strains.push_back(strains_of(mode, imaginary));
      }

      Input                            input;
      System                           system;
      std::vector<std::vector<double>> strains;
      bool                             is_static = false; ///< the first of them are those of the equilibrium
      unsigned int                     n_modes   = 0;

      SolvedStrains
      solved() const
      {
        return {input.model, strains, is_static};
      }

    private:
      std::ostringstream stream;
      Log                log;
      Context            context;

      bool
      is_loaded() const
      {
        for (const double speed : context.speeds)
          if (speed != 0.)
            return true;
        std::vector<double> r;
        State               state = context.state;
        system.residual(state, state.stress, r);
        return std::any_of(r.begin(), r.end(), [](const double force) { return std::abs(force) > 1e-12; });
      }

      std::vector<double>
      strains_of(const Mode &mode, const bool imaginary) const
      {
        std::vector<double> y(6 * system.layout.n_nodes, 0.), rates(system.layout.n_coordinates, 0.);
        const auto part = [&](const unsigned int i) { return imaginary ? mode.shape[i].imag() : mode.shape[i].real(); };
        for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
          y[6 + i] = part(i);
        for (unsigned int i = 0; i < rates.size(); ++i)
          rates[i] = part(system.layout.of_coordinate(i));
        Point<double> point = context.state.point();
        point.y             = y.data();
        point.rates         = rates.data();
        std::vector<double> e(system.layout.n_strains, 0.);
        system.strain_rates(point, e.data());
        return e;
      }
    };



    /** σ from the logarithms of the coefficients; those that vanish by symmetry say nothing. */
    double
    decay_of(const Eigen::MatrixXd &coefficients)
    {
      std::vector<double> k_seen, logarithms;
      for (unsigned int k = 0; k < coefficients.cols(); ++k)
        if (coefficients.col(k).norm() > 1e-10 * coefficients.norm())
          {
            k_seen.push_back(k);
            logarithms.push_back(std::log(coefficients.col(k).norm()));
          }
      return k_seen.size() > 1 ? -dealii::FESeries::linear_regression(k_seen, logarithms).first : 0.;
    }



    /** What an element lacks: @p fine has one coefficient more than the mesh, @p coarse is the solution of the mesh, if
     * any. */
    Indicator
    indicator_of(const Eigen::MatrixXd &fine, const Eigen::MatrixXd *coarse)
    {
      const double last = fine.rightCols(1).squaredNorm(), decay = decay_of(fine);
      const double ratio = std::min(0.8, std::exp(-2 * decay)); // of the squares
      double       error = last / (1 - ratio);
      if (coarse != nullptr && coarse->cols() + 1 == fine.cols())
        error += (fine.leftCols(fine.cols() - 1) - *coarse).squaredNorm();
      return {error, decay};
    }



    /** Twice the energy of each solution in all bodies; zero where it is round-off: rigid motions have none. */
    std::vector<double>
    energies_of(const Solution &solution)
    {
      std::vector<double> energies;
      for (const auto &e : solution.strains)
        {
          energies.push_back(energy_of_shells(solution.input.model, e));
          for (const auto *const beam : beams_of(solution.input.model))
            for (const auto &a : beam->legendre_coefficients(e.data() + beam->first_strain))
              energies.back() += a.squaredNorm();
        }
      const double largest = energies.empty() ? 0. : *std::max_element(energies.begin(), energies.end());
      for (unsigned int k = solution.is_static; k < energies.size(); ++k)
        energies[k] = energies[k] > 1e-10 * largest ? energies[k] : 0.;
      return energies;
    }



    /** Of each element of beams, errors relative to the energies of the whole model, summed over equilibrium and modes.
     */
    Indicators
    relative_indicators(const Solution &fine, const Solution &coarse, const std::vector<double> &energies)
    {
      Indicators result;
      const auto beams        = beams_of(fine.input.model);
      const auto coarse_beams = beams_of(coarse.input.model);
      for (unsigned int k = 0; k < energies.size(); ++k)
        if (energies[k] > 0)
          for (unsigned int b = 0; b < beams.size(); ++b)
            {
              const auto own = beams[b]->legendre_coefficients(fine.strains[k].data() + beams[b]->first_strain);
              std::vector<Eigen::MatrixXd> of_mesh;
              if (k == 0 && fine.is_static)
                of_mesh =
                  coarse_beams[b]->legendre_coefficients(coarse.strains[0].data() + coarse_beams[b]->first_strain);
              auto &sum = result[beams[b]->name];
              sum.resize(own.size());
              for (unsigned int i = 0; i < sum.size(); ++i)
                {
                  Indicator here = indicator_of(own[i], of_mesh.empty() ? nullptr : &of_mesh[i]);
                  here.error /= energies[k];
                  // the decay of what has the larger part of the error
                  if (here.error > sum[i].error)
                    sum[i].decay = here.decay;
                  sum[i].error += here.error;
                }
            }
      return result;
    }



    void
    refine(std::vector<MeshElement> &mesh, const unsigned int i, const bool smooth)
    {
      if (smooth && mesh[i].degree < highest_degree)
        {
          ++mesh[i].degree;
          return;
        }
      const double start = i == 0 ? 0. : mesh[i - 1].end;
      mesh.insert(mesh.begin() + i, {0.5 * (start + mesh[i].end), mesh[i].degree});
    }



    /** Refine where it is worth it; returns the square of the error relative to what is wanted. */
    double
    refine(Meshes &meshes, ShellMeshes &shells, const Solution &fine, const Solution &coarse)
    {
      const std::vector<double> energies   = energies_of(fine);
      const auto                indicators = relative_indicators(fine, coarse, energies);
      const double              of_shells  = shells.measure(fine.solved(), coarse.solved(), energies);
      double                    of_beams = 0, largest = 0, largest_geometry = 0;
      Meshes                    refined = meshes;
      for (const bool marking : {false, true})
        for (const auto *const beam : beams_of(fine.input.model))
          {
            const auto of_beam = meshes.find(beam->name);
            if (of_beam == meshes.end())
              continue;
            const BeamMesh &mesh  = of_beam->second;
            const double    scale = std::pow(mesh.wanted, -2);
            // from the end, so that what is inserted does not move what is still to come
            for (unsigned int i = mesh.elements.size(); i-- > 0;)
              {
                const auto   found = indicators.find(beam->name);
                const double error = found == indicators.end() ? 0. : scale * found->second[i].error;
                const double geometry =
                  beam->geometry_error(mesh.start(i), mesh.elements[i].end, mesh.elements[i].degree) / mesh.wanted;
                if (!marking)
                  {
                    of_beams += error;
                    largest          = std::max(largest, error);
                    largest_geometry = std::max(largest_geometry, geometry);
                  }
                else if (geometry > 1)
                  refine(refined[beam->name].elements, i, true);
                else if (error > 0.25 * largest && of_beams + of_shells > 1 && of_beams > 0.1 * of_shells)
                  refine(refined[beam->name].elements, i, found->second[i].decay > std::log(2.));
              }
          }
      meshes           = refined;
      const double sum = of_beams + of_shells;
      if (sum > 1)
        shells.refine(sum);
      return std::max(sum, largest_geometry * largest_geometry);
    }



    unsigned int
    n_elements(const Meshes &meshes)
    {
      unsigned int n = 0;
      for (const auto &mesh : meshes)
        n += mesh.second.elements.size();
      return n;
    }



    void
    tell(const Meshes &meshes, const ShellMeshes &shells, const double estimate, Log &log)
    {
      for (const auto &shell : shells.told())
        log.line("mesh of <" + shell.name + ">: " + shell.elements + ", estimated error " +
                 short_text(estimate * shell.wanted));
      for (const auto &[name, mesh] : meshes)
        {
          std::string degrees;
          for (const auto &element : mesh.elements)
            degrees += " " + std::to_string(element.degree);
          log.line("mesh of <" + name + ">: " + std::to_string(mesh.elements.size()) + " elements of degrees" +
                   degrees + ", estimated error " + short_text(estimate * mesh.wanted));
        }
    }
  } // namespace



  std::vector<std::string>
  find_meshes(const Catalogue         &catalogue,
              const InputFile         &file,
              std::vector<std::string> overrides,
              Log                     &log,
              std::vector<MeshPass>   *passes)
  {
    const Input first(catalogue, file, overrides);
    Meshes      meshes = first_meshes(first.model);
    ShellMeshes shells(first.model);
    if (meshes.empty() && shells.empty())
      return overrides;
    for (unsigned int pass = 0;
         pass < most_passes && n_elements(meshes) <= most_elements && shells.n_cells() <= most_cells;
         ++pass)
      {
        const Meshes      tried        = meshes;
        const ShellMeshes tried_shells = shells;
        try
          {
            const Solution fine(catalogue, file, with_meshes(overrides, meshes, shells, 1), true);
            const bool     with_modes = fine.n_modes > 0 && !shells.empty();
            const auto     entries    = with_meshes(overrides, meshes, shells, 0);
            const Solution coarse(catalogue,
                                  file,
                                  with_modes ? with_more_modes(entries, fine.n_modes) : entries,
                                  with_modes);
            const double   estimate = std::sqrt(refine(meshes, shells, fine, coarse));
            if (passes != nullptr)
              passes->push_back({coarse.system.size(), estimate});
            if (estimate <= 1)
              {
                tell(tried, tried_shells, estimate, log);
                return with_meshes(overrides, tried, tried_shells, 0);
              }
          }
        catch (const NotConverged &problem)
          {
            // perhaps the mesh is too coarse
            if (pass > 4)
              throw;
            log.line(std::string("the mesh is refined everywhere: ") + problem.what());
            for (auto &mesh : meshes)
              for (unsigned int i = mesh.second.elements.size(); i-- > 0;)
                refine(mesh.second.elements, i, false);
            shells.refine_everywhere();
          }
      }
    throw NotConverged(
      "automatic elements: no mesh has been found that meets the wanted error; take a larger one, or give "
      "the number of <Elements>.");
  }
} // namespace samara
