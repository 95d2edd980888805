#include <samara/analysis/mode_content.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace samara
{
  namespace
  {
    /** Share of energy from which on a word stands for all. */
    constexpr double clear_pattern = 0.75;

    const std::array<std::string, 3> family_names = {"flap", "lag", "torsion"};



    /** The family of each number of a motion: along the radius nothing has a name, and it counts as lag. */
    constexpr std::array<unsigned int, 6> family_of = {0, 1, 1, 0, 1, 2};

  } // namespace



  ContentOfModes::ContentOfModes(const System &system, const RepeatedParts &parts, const std::vector<State> &orbit)
    : system(system)
    , orbit(orbit)
    , n_parts(parts.n())
  {
    std::vector<bool> seen(system.layout.n_nodes, false);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      if (!seen[node] && parts.next_of_node(node) != node)
        {
          chains.emplace_back();
          for (unsigned int i = node; !seen[i]; i = parts.next_of_node(i))
            {
              chains.back().push_back(i);
              seen[i] = true;
            }
        }
    find_axis();
  }



  void
  ContentOfModes::find_axis()
  {
    const double n       = double(orbit.size()) * chains.size() * n_parts;
    double       fastest = 0, turning = 0, size = 0;
    const auto   for_all = [&](const auto &f) {
      for (const auto &state : orbit)
        for (const auto &chain : chains)
          for (const unsigned int node : chain)
            f(state, node);
    };
    for_all([&](const State &state, const unsigned int node) {
      const Vector3 spin = state.triad(node) * Eigen::Map<const Vector3>(&state.y[6 * node + 3]);
      axis += spin / n;
      centre += state.position(node) / n;
      fastest = std::max(fastest, spin.norm());
    });
    const double speed = axis.norm();
    if (speed > 0)
      axis /= speed;
    // parts that turn about axes of their own, as planets of a gear, are no blades
    for_all([&](const State &state, const unsigned int node) {
      const Vector3 arm = state.position(node) - centre, across = arm - axis * axis.dot(arm);
      turning += axis.dot(across.cross(state.triad(node) * Eigen::Map<const Vector3>(&state.y[6 * node])));
      size += across.squaredNorm();
    });
    // parts go round together: the mean spin is not small beside the largest, and points move as it says, to a tenth
    if (!(speed > 0.1 * fastest) || !(std::abs(turning - speed * size) < 0.1 * speed * size))
      chains.clear();
  }



  ContentOfModes::Motion
  ContentOfModes::motion_of(const State            &state,
                            const Eigen::VectorXcd &x,
                            const unsigned int      node,
                            const bool              in_energy) const
  {
    const Matrix6 &inertia = system.model.nodes[node].inertia;
    const Matrix3  D       = state.triad(node);
    const Vector3  arm = state.position(node) - centre, across = arm - axis * axis.dot(arm);
    const Vector3  e_r = across.norm() > 0 ? Vector3(across.normalized()) : Vector3::Zero(), e_t = axis.cross(e_r);
    const Eigen::Vector3cd u     = x.segment<3>(system.layout.of_node(node)),
                           theta = x.segment<3>(system.layout.of_node(node) + 3);
    const double           m     = inertia(0, 0);
    const Vector3          c     = centre_of_mass(inertia);
    const Eigen::Vector3cd u_c   = D.cast<Complex>() *
                                 (in_energy ? Eigen::Vector3cd(u - skew(c).cast<Complex>() * theta) : u),
                           turned = D.cast<Complex>() * theta;
    const Matrix3 J               = D * (inertia.bottomRightCorner<3, 3>() + m * skew(c) * skew(c)) * D.transpose();
    const auto    weight = [&](const Vector3 &e) { return in_energy ? std::sqrt(std::max(0., e.dot(J * e))) : 1.; };
    const auto    along  = [](const Vector3 &e, const Eigen::Vector3cd &v) {
      return (e.cast<Complex>().transpose() * v)(0, 0);
    };
    const double mass = in_energy ? std::sqrt(std::max(0., m)) : 1.;
    Motion       result;
    result << mass * along(axis, u_c), mass * along(e_t, u_c), mass * along(e_r, u_c), weight(e_t) * along(e_t, turned),
      weight(axis) * along(axis, turned), weight(e_r) * along(e_r, turned);
    return result;
  }



  double
  ContentOfModes::energy_of_others(const Weighing &weighing, const Eigen::VectorXcd &x) const
  {
    std::vector<bool> repeated(system.layout.n_nodes, false);
    for (const auto &chain : chains)
      for (const unsigned int node : chain)
        repeated[node] = true;
    double sum = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      if (!repeated[node])
        sum += weighing.part(product_of_node(system, weighing.y, x, node));
    return sum;
  }



  /** How often signs change along the part that moves most, and one: "2". */
  std::string
  ContentOfModes::number_along(const State &state, const Eigen::VectorXcd &x, const unsigned int family) const
  {
    const unsigned int                     number  = family == 2 ? 5 : family; // of what is looked at in a motion
    unsigned int                           most    = 0;
    double                                 largest = -1;
    std::vector<std::map<double, Complex>> along(n_parts); // by radius
    for (unsigned int k = 0; k < n_parts; ++k)
      {
        double sum = 0;
        for (const auto &chain : chains)
          {
            const Motion  motion                          = motion_of(state, x, chain[k], false);
            const Vector3 arm                             = state.position(chain[k]) - centre;
            along[k][(arm - axis * axis.dot(arm)).norm()] = motion(number);
            sum += std::norm(motion(number));
          }
        if (sum > largest)
          {
            largest = sum;
            most    = k;
          }
      }
    std::vector<Complex> outwards;
    for (const auto &[radius, value] : along[most])
      outwards.push_back(value);
    return std::to_string(parts_of_alternating_sign(outwards));
  }



  std::string
  ContentOfModes::name_of_pattern(const std::vector<double> &energies, const double frequency, double &share) const
  {
    const int Q     = n_parts;
    double    total = 0;
    for (const double e : energies)
      total += e;
    share = 0;
    if (!(total > 0))
      return "";
    std::string name = "mixed";
    const auto  take = [&](const std::string &candidate, const double energy) {
      if (energy / total <= share)
        return;
      share = energy / total;
      name  = candidate;
    };
    for (int m = 0; m < Q; ++m)
      {
        // wave number, positive with the sense of turning; that of the conjugate mode is the opposite one
        const int wave = (2 * m <= Q ? m : m - Q) * (frequency < 0 ? -1 : 1);
        if (m == 0)
          take("collective", energies[m]);
        else if (2 * m == Q)
          take("differential", energies[m]);
        else if (frequency == 0)
          take(std::abs(wave) == 1 ? "cyclic" : "cyclic " + std::to_string(std::abs(wave)),
               energies[m] + energies[Q - m]);
        else
          take(std::string(wave > 0 ? "progressive" : "regressive") +
                 (std::abs(wave) == 1 ? "" : " " + std::to_string(std::abs(wave))),
               energies[m]);
      }
    return share >= clear_pattern ? name : "mixed";
  }



  std::vector<Eigen::MatrixXcd>
  ContentOfModes::energies_of_patterns(const Eigen::MatrixXcd &shapes) const
  {
    std::vector<Eigen::MatrixXcd> result;
    if (chains.empty())
      return result;
    constexpr int    n_numbers = Motion::RowsAtCompileTime;
    Eigen::MatrixXcd of_part(n_numbers * chains.size(), shapes.cols());
    for (unsigned int m = 0; m < n_parts; ++m)
      {
        of_part.setZero();
        for (int j = 0; j < shapes.cols(); ++j)
          for (unsigned int i = 0; i < chains.size(); ++i)
            for (unsigned int k = 0; k < n_parts; ++k)
              of_part.block<n_numbers, 1>(n_numbers * i, j) +=
                std::polar(1., 2 * M_PI * m * k / n_parts) * motion_of(orbit[0], shapes.col(j), chains[i][k], true);
        result.emplace_back(of_part.adjoint() * of_part / double(n_parts));
      }
    return result;
  }



  ModeContent
  ContentOfModes::of(const std::vector<Eigen::VectorXcd> &increments,
                     const double                         frequency,
                     const Eigen::VectorXcd              &left) const
  {
    ModeContent result;
    if (chains.empty())
      return result;
    std::array<double, 3> families = {0, 0, 0};
    std::vector<double>   patterns(n_parts, 0.);
    double                others = 0;
    for (unsigned int i = 0; i < std::min(increments.size(), orbit.size()); ++i)
      {
        const Weighing weighing(system, increments[i], left);
        others += energy_of_others(weighing, increments[i]);
        for (const auto &chain : chains)
          {
            std::vector<Motion> motions;
            for (const unsigned int node : chain)
              {
                motions.push_back(motion_of(orbit[i], increments[i], node, true));
                const Motion of_left = motion_of(orbit[i], weighing.y, node, true);
                for (unsigned int j = 0; j < 6; ++j)
                  families[family_of[j]] += weighing.part(of_left(j) * motions.back()(j));
              }
            for (unsigned int m = 0; m < n_parts; ++m)
              {
                Motion sum = Motion::Zero();
                for (unsigned int k = 0; k < n_parts; ++k)
                  sum += std::polar(1., 2 * M_PI * m * k / n_parts) * motions[k];
                patterns[m] += sum.squaredNorm() / n_parts;
              }
          }
      }
    const double of_parts = families[0] + families[1] + families[2], total = of_parts + others;
    if (!(total > 0))
      return result;
    result.pattern            = name_of_pattern(patterns, frequency, result.pattern_share);
    const unsigned int most   = std::max_element(families.begin(), families.end()) - families.begin();
    unsigned int       second = most == 0 ? 1 : 0;
    for (unsigned int f = 0; f < 3; ++f)
      if (f != most && families[f] > families[second])
        second = f;
    result.family_share = families[most] / total;
    if (others > 0.5 * total)
      {
        result.family       = "support";
        result.family_share = others / total;
      }
    else if (families[most] >= clear_share_of_family * of_parts)
      result.family = family_names[most] + " " + number_along(orbit[0], increments[0], most);
    else
      result.family = family_names[most] + "-" + family_names[second];
    return result;
  }
} // namespace samara
