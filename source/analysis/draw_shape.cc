#include <samara/analysis/draw_shape.h>
#include <samara/output/pictures.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Of a phase in which it is largest, at a twentieth of the model's size; empty if nothing moves. */
    Eigen::VectorXcd
    normalised(const System &system, const Eigen::VectorXcd &shape)
    {
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
        return {};
      return shape * (0.05 * model_length(system.model) / largest / phase);
    }



    /** The state moved by the real part of this multiple of a shape. */
    State
    moved_by(const System               &system,
             const State                &about,
             const Eigen::VectorXcd     &shape,
             const std::complex<double> &factor)
    {
      std::vector<double> z(system.size(), 0.);
      for (int i = 0; i < shape.size(); ++i)
        z[i] = (shape(i) * factor).real();
      State state = about;
      system.update(state, z);
      return state;
    }
  } // namespace



  void
  draw_shape(const System      &system,
             const State       &about,
             Eigen::VectorXcd   shape,
             const double       period,
             const std::string &folder,
             const std::string &name)
  {
    shape = normalised(system, shape);
    if (shape.size() == 0)
      return;

    Pictures           pictures(folder, name);
    const unsigned int n_frames = 24;
    for (unsigned int frame = 0; frame < n_frames; ++frame)
      {
        const State state = moved_by(system, about, shape, std::polar(1., 2 * M_PI * frame / n_frames));
        pictures.add(system.draw(state), period * frame / n_frames);
      }
    pictures.finish();
  }



  void
  show_shape(const System            &system,
             const State             &about,
             const Eigen::VectorXcd  &shape,
             const ReportPage::Shape &what,
             ReportPage              &page)
  {
    // differences of drawings: what they leave out is of order ε², and what is rounded of order 1e-16/ε
    constexpr double           epsilon = 1e-4;
    const std::complex<double> i(0, 1);
    const Eigen::VectorXcd     z = normalised(system, shape);
    if (z.size() == 0)
      return;
    const auto at = [&](const std::complex<double> &factor) {
      return system.draw(moved_by(system, about, z, factor), Drawing::Content::places);
    };
    const auto mean = [&](const Drawing::Content content) { return system.draw(about, content); };
    page.add_shape(what, mean, {{at(epsilon), at(-epsilon), at(i * epsilon), at(-i * epsilon)}}, epsilon);
  }



  std::string
  draw_free_motions(const System      &system,
                    const ModelCheck  &check,
                    const std::string &folder,
                    const unsigned int most,
                    ReportPage *const  page)
  {
    const unsigned int n = std::min<std::size_t>(most, check.shapes.size());
    for (unsigned int k = 0; k < n; ++k)
      {
        const Eigen::VectorXcd shape = check.shapes[k].cast<std::complex<double>>();
        ReportPage::Shape      what;
        what.name   = "free_motion_" + std::to_string(k + 1);
        what.number = k + 1;
        draw_shape(system, system.reference(), shape, 1., folder, what.name);
        if (page != nullptr && page->draws())
          show_shape(system, system.reference(), shape, what, *page);
      }
    if (n == 0)
      return "";
    return "the free motions are drawn in free_motion_1.pvd" +
           (n > 1 ? " to free_motion_" + std::to_string(n) + ".pvd" : std::string()) +
           (n < check.n_free_motions ? ", the others are not" : "");
  }
} // namespace samara
