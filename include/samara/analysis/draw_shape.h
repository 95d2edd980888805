#ifndef samara_analysis_draw_shape_h
#define samara_analysis_draw_shape_h

#include <samara/analysis/check.h>
#include <samara/report/report_page.h>

namespace samara
{
  /**
   * A shape of vibration about a state as a series of pictures, FOLDER/NAME.pvd: a period of 24 pictures, which begins
   * where the shape is largest, a twentieth of the model's size. @p shape: increments of all unknowns but multipliers.
   */
  void draw_shape(const System      &system,
                  const State       &about,
                  Eigen::VectorXcd   shape,
                  double             period,
                  const std::string &folder,
                  const std::string &name);

  /**
   * The same shape on the page of a report: drawings of the state moved by small parts of it. An amplitude of one is that
   * of the pictures.
   */
  void show_shape(const System            &system,
                  const State             &about,
                  const Eigen::VectorXcd  &shape,
                  const ReportPage::Shape &what,
                  ReportPage              &page);

  /**
   * The free motions of the reference configuration as such series, free_motion_1 ..., at most @p most; on the @p page,
   * too, if there is one. Says which files there are.
   */
  std::string draw_free_motions(const System      &system,
                                const ModelCheck  &check,
                                const std::string &folder,
                                unsigned int       most,
                                ReportPage        *page = nullptr);
} // namespace samara

#endif
