#include <samara/analysis/draw_shape.h>
#include <samara/output/pictures.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  draw_shape(const System      &system,
             const State       &about,
             Eigen::VectorXcd   shape,
             const double       period,
             const std::string &folder,
             const std::string &name)
  {
    // the phase in which it is largest comes first, at a twentieth of the model's size
    double               largest = 0;
    std::complex<double> phase   = 1;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      for (unsigned int i = 0; i < 6; ++i)
        {
          // a rotation counts by what it moves at a tenth of the model's length
          const auto   z    = shape(system.layout.of_node(node) + i);
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

    Pictures           pictures(folder, name);
    const unsigned int n_frames = 24;
    for (unsigned int frame = 0; frame < n_frames; ++frame)
      {
        const std::complex<double> turn = std::polar(1., 2 * M_PI * frame / n_frames);
        std::vector<double>        z(system.size(), 0.);
        for (int i = 0; i < shape.size(); ++i)
          z[i] = (shape(i) * turn).real();
        State state = about;
        system.update(state, z);
        pictures.add(system.draw(state), period * frame / n_frames);
      }
    pictures.finish();
  }



  std::string
  draw_free_motions(const System &system, const ModelCheck &check, const std::string &folder, const unsigned int most)
  {
    const unsigned int n = std::min<std::size_t>(most, check.shapes.size());
    for (unsigned int k = 0; k < n; ++k)
      draw_shape(system,
                 system.reference(),
                 check.shapes[k].cast<std::complex<double>>(),
                 1.,
                 folder,
                 "free_motion_" + std::to_string(k + 1));
    if (n == 0)
      return "";
    return "the free motions are drawn in free_motion_1.pvd" +
           (n > 1 ? " to free_motion_" + std::to_string(n) + ".pvd" : std::string()) +
           (n < check.n_free_motions ? ", the others are not" : "");
  }
} // namespace samara
