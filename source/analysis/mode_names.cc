#include <samara/analysis/mode_names.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace samara
{
  namespace
  {
    constexpr unsigned int most_slices       = 24;
    constexpr double       least_slenderness = 2; ///< of what is called a blade
    constexpr const char  *words_of_modes[]  = {"flap", "lag", "torsion", "stretch"};

    using Vector3c = Eigen::Vector3cd;



    /** A node as a rigid body: place and velocity of its mass centre, spin, inertia about it, in inertial axes. */
    struct MovingMass
    {
      double   m;
      Vector3  at;
      Matrix3  J;
      Vector3c velocity, spin;

      MovingMass(const System &system, const State &state, const Eigen::VectorXcd &x, const unsigned int node)
      {
        const Matrix6 &inertia = system.model.nodes[node].inertia;
        const Matrix3  D       = state.triad(node);
        m                      = inertia(0, 0);
        const Vector3 centre   = centre_of_mass(inertia);
        const Matrix3 c        = skew(centre);
        const int     row      = system.layout.of_node(node);
        at                     = state.position(node) + D * centre;
        J                      = D * (inertia.bottomRightCorner<3, 3>() + m * c * c) * D.transpose();
        spin                   = D.cast<std::complex<double>>() * x.segment<3>(row + 3);
        velocity =
          D.cast<std::complex<double>>() * (x.segment<3>(row) - c.cast<std::complex<double>>() * x.segment<3>(row + 3));
      }
    };



    /** Part along a direction. */
    std::complex<double>
    part_along(const Vector3 &e, const Vector3c &v)
    {
      return (e.cast<std::complex<double>>().transpose() * v)(0, 0);
    }



    double
    range_of(const std::vector<Vector3> &points, const Vector3 &e)
    {
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (const auto &p : points)
        {
          least = std::min(least, e.dot(p));
          most  = std::max(most, e.dot(p));
        }
      return most - least;
    }

  } // namespace



  ModeNames::ModeNames(const System &system, const State &turning)
    : system(system)
    , state(turning)
  {
    std::map<std::string, std::vector<unsigned int>> bodies;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      bodies[system.model.nodes[node].name].push_back(node);
    for (const auto &[name, nodes] : bodies)
      add_blade(nodes);
  }



  void
  ModeNames::add_blade(const std::vector<unsigned int> &nodes)
  {
    Vector3 spin = Vector3::Zero(), mean = Vector3::Zero();
    double  fastest = 0;
    for (const auto node : nodes)
      {
        spin += state.motion[node].spin / nodes.size();
        fastest = std::max(fastest, state.motion[node].spin.norm());
      }
    others.insert(others.end(), nodes.begin(), nodes.end());
    const double speed = spin.norm();
    // the mean of the spins is small where nodes stand still or turn about other axes: that is no blade
    if (nodes.size() < 2 || !(speed > 0.5 * fastest))
      return;
    Blade                blade;
    std::vector<Vector3> arms;
    blade.axis = spin / speed;
    for (const auto node : nodes)
      {
        const Vector3 arm = state.motion[node].velocity.cross(spin) / (speed * speed); // from the axis
        mean += arm / nodes.size();
        arms.push_back(arm + blade.axis * blade.axis.dot(state.position(node)));
      }
    if (!(mean.norm() > 0))
      return;
    blade.along         = mean.normalized();
    blade.circle        = blade.axis.cross(blade.along);
    const double length = range_of(arms, blade.along);
    // long, and on one side of the axis: what the axis passes through in the middle is a bar, not a blade
    if (!(length > least_slenderness * std::max(range_of(arms, blade.circle), range_of(arms, blade.axis))) ||
        !(mean.norm() > 0.25 * length))
      return;
    double start = std::numeric_limits<double>::infinity();
    for (const auto &arm : arms)
      start = std::min(start, blade.along.dot(arm));
    for (const auto &arm : arms)
      blade.slices.push_back(
        std::min<unsigned int>(most_slices - 1, most_slices * (blade.along.dot(arm) - start) / length));
    blade.nodes    = nodes;
    blade.n_slices = most_slices;
    others.resize(others.size() - nodes.size());
    blades.push_back(std::move(blade));
  }



  double
  ModeNames::energy_of(const Mode &mode, const Weighing &weighing, const std::vector<unsigned int> &nodes) const
  {
    double sum = 0;
    for (const auto node : nodes)
      sum += weighing.part(product_of_node(system, weighing.y, mode.shape, node));
    return sum;
  }



  struct ModeNames::Slice
  {
    std::array<double, n_families>  weights;
    std::array<Complex, n_families> motion;
  };



  ModeNames::Slice
  ModeNames::slice_of(const Blade &blade, const unsigned int slice, const Eigen::VectorXcd &x) const
  {
    std::vector<MovingMass> masses;
    double                  m      = 0;
    Vector3                 centre = Vector3::Zero();
    Vector3c                p      = Vector3c::Zero();
    for (unsigned int i = 0; i < blade.nodes.size(); ++i)
      if (blade.slices[i] == slice)
        {
          masses.emplace_back(system, state, x, blade.nodes[i]);
          m += masses.back().m;
          centre += masses.back().m * masses.back().at;
          p += masses.back().m * masses.back().velocity;
        }
    if (!(m > 0))
      return {};
    Complex spin_momentum = 0;
    double  J             = 0;
    for (const auto &mass : masses)
      {
        const Vector3 arm = mass.at - centre / m;
        spin_momentum +=
          mass.m * part_along(blade.along.cross(arm), mass.velocity) + part_along(mass.J * blade.along, mass.spin);
        J += mass.m * blade.along.cross(arm).squaredNorm() + blade.along.dot(mass.J * blade.along);
      }
    return {{m, m, J, m},
            {part_along(blade.axis, p) / m,
             part_along(blade.circle, p) / m,
             J > 0 ? spin_momentum / J : Complex(0),
             part_along(blade.along, p) / m}};
  }



  ModeNames::Content
  ModeNames::content_of(const Blade &blade, const Mode &mode, const Weighing &weighing) const
  {
    Content result;
    result.total = energy_of(mode, weighing, blade.nodes);
    for (unsigned int slice = 0; slice < blade.n_slices; ++slice)
      {
        const Slice right = slice_of(blade, slice, mode.shape), left = slice_of(blade, slice, weighing.y);
        if (!(right.weights[0] > 0))
          continue;
        for (unsigned int f = 0; f < n_families; ++f)
          result.energies[f] += weighing.part(right.weights[f] * left.motion[f] * right.motion[f]);
        result.motions.push_back(right.motion);
      }
    return result;
  }



  std::string
  ModeNames::of(const Mode &mode) const
  {
    const Weighing                 weighing(system, mode.shape, mode.left);
    std::array<double, n_families> energies{};
    double                         total = 0;
    Content                        most; // of the blade that moves most
    for (const auto &blade : blades)
      {
        const Content content = content_of(blade, mode, weighing);
        total += content.total;
        for (unsigned int f = 0; f < n_families; ++f)
          energies[f] += content.energies[f];
        if (content.total > most.total)
          most = content;
      }
    if (!(total > energy_of(mode, weighing, others)))
      return "";
    double sum = 0;
    for (const double e : energies)
      sum += e;
    if (sum < 0.5 * total)
      return "local";
    std::array<unsigned int, n_families> order = {0, 1, 2, 3};
    std::sort(order.begin(), order.end(), [&](const auto i, const auto j) { return energies[i] > energies[j]; });
    if (energies[order[0]] < clear_share_of_family * sum)
      return std::string(words_of_modes[std::min(order[0], order[1])]) + "-" +
             words_of_modes[std::max(order[0], order[1])];
    std::vector<Complex> along;
    for (const auto &motion : most.motions)
      along.push_back(motion[order[0]]);
    return words_of_modes[order[0]] + (" " + std::to_string(parts_of_alternating_sign(along)));
  }
} // namespace samara
