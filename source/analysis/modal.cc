#include <samara/analysis/finite_matrix.h>
#include <samara/analysis/modal.h>
#include <samara/output/pictures.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace samara
{
  namespace
  {
    /** The constant rotation rate of each node's axes, blockdiag(Ω~, Ω~). */
    Matrix6
    turning(const State &state, const unsigned int node)
    {
      Matrix6 W                 = Matrix6::Zero();
      W.topLeftCorner<3, 3>() = W.bottomRightCorner<3, 3>() =
        skew(Eigen::Map<const Vector6>(&state.y[6 * node]).tail<3>());
      return W;
    }



    /** B += factor · A W, W block diagonal with one block for each node. */
    void
    add_times_turning(const System &system, const State &state, const double factor, const SparseMatrix &A, SparseMatrix &B)
    {
      const Pattern &pattern = *A.pattern;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const Matrix6 W     = factor * turning(state, node);
          const int     first = system.layout.of_node(node);
          // the six columns of a node have the same rows, as all couplings are by nodes
          const int n = pattern.column_start[first + 1] - pattern.column_start[first];
          const Eigen::Map<const Eigen::MatrixXd> a(&A.values[pattern.column_start[first]], n, 6);
          Eigen::Map<Eigen::MatrixXd>             b(&B.values[pattern.column_start[first]], n, 6);
          b += a * W;
        }
    }
  } // namespace



  Linearization::Linearization(const System &system, const State &state, const bool fixed_axes)
    : M(system.layout.pattern)
    , C(system.layout.pattern)
    , K(system.layout.pattern)
  {
    system.mass(M);
    system.damping(state, C);
    system.tangent(state, K);
    if (!fixed_axes)
      return;
    // ζ = Rᵀη with R turning at W: ζ̇ = η̇ − Wη, ζ̈ = η̈ − 2Wη̇ + W²η
    SparseMatrix MW(system.layout.pattern);
    add_times_turning(system, state, 1., M, MW);
    add_times_turning(system, state, -1., C, K);
    add_times_turning(system, state, 1., MW, K);
    C.add(-2., MW);
  }



  void
  ModalAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Modes", n_modes, "Number of modes, those of lowest frequency.", Integer(1));
    prm.add("Shift",
            shift,
            "Modes nearest to this real number are found; it must not be an eigenvalue itself, such as 0 when something can "
            "move freely [rad/s].");
    prm.add("Hold rotations", hold, "Whether joints in steady rotation keep their speed, or are free to follow the motion.");
    prm.add("Axes",
            axes,
            "Axes in which small motions are seen: turning with each body; fixed in space at the moment of the state; "
            "automatic: turning, unless parts turn against each other.",
            Selection("automatic|turning|fixed"));
    prm.add(
      "Unsteady motion",
      unsteady,
      "Where parts that turn against each other do not turn steadily, as a universal joint on a bend: refuse, or allow, "
      "and find the modes of the moment, if it is known that little changes.",
      Selection("refuse|allow"));
    prm.add("Animations", n_animations, "Number of modes for which a moving picture is written.", Integer(0));
  }



  void
  ModalAnalysis::run(Context &context)
  {
    const System &system = context.system;
    if (!context.is_equilibrium)
      {
        set_steady_motion(system, context.state, context.speeds);
        system.stresses(context.state, context.state.stress);
      }
    require_finite_state(system, context.state);
    check_motion(context);
    State state = context.state;
    state.held  = hold;
    if (!state.left_out.empty())
      RedundantRows(system).choose(state);

    const bool fixed = axes == "fixed" || (axes == "automatic" && !turns_as_a_whole(system, state));
    if (fixed)
      context.log.line("  modal: parts turn against each other; modes are those seen in fixed axes at this moment "
                       "(constant in time if the turning parts are axisymmetric)");
    const Linearization linearization(system, state, fixed);
    for (const auto *const A : {&linearization.M, &linearization.C, &linearization.K})
      require_finite_matrix(system, *A);
    try
      {
        modes = find_modes(linearization.M,
                           linearization.C,
                           linearization.K,
                           system.layout.of_multiplier(0),
                           n_modes,
                           shift);
      }
    catch (const SingularMatrix &singular)
      {
        throw NotConverged("modal analysis: the matrix is singular at " +
                           (singular.unknown < 0 ? std::string("an unknown") : system.layout.name_of(singular.unknown)) +
                           ".\n  Choose a <Shift> that is not an eigenvalue (not 0 if something can move freely); if it "
                           "stays singular, a constraint is there twice or something has neither mass nor stiffness.");
      }
    track(linearization);
    report(context);
    if (!context.sweep.empty())
      {
        if (!fan)
          fan = std::make_unique<Table>(std::vector<std::string>{"speed [rad/s]",
                                                                 "branch",
                                                                 "frequency [rad/s]",
                                                                 "damping ratio",
                                                                 "real [1/s]",
                                                                 "imaginary [rad/s]"});
        for (unsigned int i = 0; i < modes.size(); ++i)
          fan->add_row({context.speeds[0],
                        branches[i],
                        modes[i].frequency(),
                        modes[i].damping_ratio(),
                        modes[i].lambda.real(),
                        modes[i].lambda.imag()});
      }
    if (context.pictures && context.is_shown() && !context.folder.empty())
      for (unsigned int k = 0; k < std::min<unsigned int>(n_animations, modes.size()); ++k)
        animate(context, k);
  }



  void
  ModalAnalysis::check_motion(const Context &context) const
  {
    State              turning = context.state;
    const SteadyMotion motion  = set_steady_motion(context.system, turning, context.speeds);
    if (motion.is_steady())
      return;
    const std::string why =
      "parts do not turn steadily: " + why_not_steady(context.system, turning, context.speeds, motion);
    if (unsteady == "refuse")
      throw InputError(
        (parameters.where().empty() ? "" : parameters.where() + ": ") + "modal analysis: " + why +
        ".\n  Modes belong to a motion that stays as it is. If they are wanted for the moment nevertheless, set "
        "Unsteady motion = allow in subsection Modal.");
    context.log.line("  modal: " + why + "; modes are those of this moment");
  }



  void
  ModalAnalysis::track(const Linearization &linearization)
  {
    branches.assign(modes.size(), 0);
    std::vector<Mode> by_branch;
    if (previous.empty())
      {
        for (unsigned int i = 0; i < modes.size(); ++i)
          branches[i] = i + 1;
        previous = modes;
        return;
      }
    // mass-weighted assurance criterion between all pairs, the best pairs first
    const unsigned int n = modes[0].shape.size();
    const auto weighted  = [&](const Eigen::VectorXcd &shape) {
      std::vector<double> re(linearization.M.pattern->size(), 0.), im = re, Mre = re, Mim = re;
      for (unsigned int i = 0; i < n; ++i)
        {
          re[i] = shape(i).real();
          im[i] = shape(i).imag();
        }
      linearization.M.multiply(re.data(), Mre.data());
      linearization.M.multiply(im.data(), Mim.data());
      Eigen::VectorXcd result(n);
      for (unsigned int i = 0; i < n; ++i)
        result(i) = {Mre[i], Mim[i]};
      return result;
    };
    std::vector<Eigen::VectorXcd> weighted_shapes;
    for (const auto &mode : modes)
      weighted_shapes.push_back(weighted(mode.shape));
    std::vector<std::tuple<double, unsigned int, unsigned int>> pairs;
    for (unsigned int j = 0; j < previous.size(); ++j)
      {
        const double norm = previous[j].shape.dot(weighted(previous[j].shape)).real();
        for (unsigned int i = 0; i < modes.size(); ++i)
          pairs.emplace_back(std::norm(previous[j].shape.dot(weighted_shapes[i])) /
                               std::max(1e-300, norm * modes[i].shape.dot(weighted_shapes[i]).real()),
                             i,
                             j);
      }
    std::sort(pairs.rbegin(), pairs.rend());
    std::vector<bool> taken(previous.size(), false);
    for (const auto &[mac, i, j] : pairs)
      if (branches[i] == 0 && !taken[j] && mac > 0.3)
        {
          branches[i] = j + 1;
          taken[j]    = true;
          previous[j] = modes[i];
        }
    // shapes never seen before begin new branches
    for (unsigned int i = 0; i < modes.size(); ++i)
      if (branches[i] == 0)
        {
          previous.push_back(modes[i]);
          branches[i] = previous.size();
        }
  }



  std::vector<std::pair<std::string, double>>
  participation(const System &system, const Mode &mode)
  {
    std::map<std::string, double> energy;
    double                        total = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Matrix<std::complex<double>, 6, 1> z = mode.shape.segment<6>(system.layout.of_node(node));
        const double e = (z.adjoint() * system.model.nodes[node].inertia * z)(0, 0).real();
        energy[system.model.nodes[node].name] += e;
        total += e;
      }
    std::vector<std::pair<std::string, double>> shares;
    for (const auto &[name, e] : energy)
      shares.emplace_back(name, total > 0 ? e / total : 0.);
    std::sort(shares.begin(), shares.end(), [](const auto &a, const auto &b) { return a.second > b.second; });
    return shares;
  }



  void
  ModalAnalysis::report(Context &context) const
  {
    Table table({"mode", "frequency [rad/s]", "frequency [Hz]", "damping ratio", "real [1/s]", "imaginary [rad/s]"});
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        const Mode &m = modes[i];
        table.add_row({i + 1, m.frequency(), m.frequency() / (2 * M_PI), m.damping_ratio(), m.lambda.real(), m.lambda.imag()});
        std::ostringstream line;
        line << "  mode " << i + 1 << ": " << short_text(m.frequency()) << " rad/s, damping ratio "
             << short_text(std::abs(m.damping_ratio()) < 1e-10 ? 0. : m.damping_ratio()) << "  (";
        const auto shares = participation(context.system, m);
        for (unsigned int k = 0; k < std::min<unsigned int>(3, shares.size()) && (k == 0 || shares[k].second > 0.02); ++k)
          line << (k > 0 ? ", " : "") << shares[k].first << " " << std::lround(100 * shares[k].second) << " %";
        context.log.line(line.str() + ")");
      }
    if (context.folder.empty())
      return;
    if (!context.sweep.empty())
      table.write(context.folder + "/modes_" + short_text(context.speeds[0]) + ".csv");
    if (context.is_shown())
      table.write(context.folder + "/modes.csv");
  }



  void
  ModalAnalysis::animate(const Context &context, const unsigned int k) const
  {
    const System &system = context.system;
    Eigen::VectorXcd shape = modes[k].shape;
    // the phase in which it is largest comes first, at a twentieth of the model's size
    double               largest = 0;
    std::complex<double> phase   = 1;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      for (unsigned int i = 0; i < 6; ++i)
        {
          const auto   z = shape(system.layout.of_node(node) + i);
          const double size = std::abs(z) * (i < 3 ? 1. : 0.1 * model_length(system.model));
          if (size > largest)
            {
              largest = size;
              phase   = z / std::abs(z);
            }
        }
    if (largest == 0)
      return;
    shape *= 0.05 * model_length(system.model) / largest / phase;

    Pictures           pictures(context.folder, "mode_" + std::to_string(k + 1));
    const unsigned int n_frames = 24;
    for (unsigned int frame = 0; frame < n_frames; ++frame)
      {
        const std::complex<double> turn = std::polar(1., 2 * M_PI * frame / n_frames);
        std::vector<double>        z(system.size(), 0.);
        for (int i = 0; i < shape.size(); ++i)
          z[i] = (shape(i) * turn).real();
        State state = context.state;
        system.update(state, z);
        Drawing drawing;
        for (const auto &c : system.model.contributions)
          c->draw(state, drawing);
        const double period = modes[k].lambda.imag() > 0 ? 2 * M_PI / modes[k].lambda.imag() : 1.;
        pictures.add(std::move(drawing), period * frame / n_frames);
      }
    pictures.finish();
  }



  void
  ModalAnalysis::finish(Context &context)
  {
    if (fan && !context.folder.empty())
      fan->write(context.folder + "/fan.csv");
  }
} // namespace samara
