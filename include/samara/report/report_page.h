#ifndef samara_report_report_page_h
#define samara_report_report_page_h

#include <samara/base/log.h>
#include <samara/report/csv_columns.h>
#include <samara/report/drawn_model.h>
#include <samara/report/writing_pace.h>

#include <array>
#include <complex>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace samara
{
  /**
   * What a run draws, for its page report.html: motions as pictures of samples, shapes of vibration as their parts in
   * and behind phase, so that any amplitude can be shown. What the page says besides, tables, model and messages, is
   * read from the folder of the results, see write_report().
   *
   *     FOLDER/report.data    what is drawn, of this run; report.1.data ... of runs before --restart
   *     FOLDER/run.log        all that was said
   *     FOLDER/report.html    the page
   */
  class ReportPage
  {
  public:
    struct Settings
    {
      std::string  folder;
      unsigned int n_pictures   = 150;         ///< of a motion
      std::string  fields       = "automatic"; ///< "all" components, "sizes", or what the page has room for
      bool         watch        = false;       ///< write the page again and again while the run goes on
      bool         goes_on      = false;       ///< behind the run whose data are in the folder
      bool         is_too_large = false;       ///< for a drawing; the page says so
    };

    /** @p reference: the undeformed model, drawn. */
    ReportPage(const Settings &settings, const Model &model, Drawing &&reference, const Log &log);

    const Settings settings;

    /** Draws a state; the page asks for no more than it has not yet. */
    using Draw = std::function<Drawing(Drawing::Content)>;

    /** What of a whole drawing is asked for. */
    static Draw
    of(const Drawing &whole)
    {
      return [&whole](const Drawing::Content content) { return whole.only(content); };
    }

    /**
     * A picture of a series: "dynamic", "static". Of too many every second one is kept. @p at: s, or a load factor. A
     * drawing with other objects than those before in its series is left out, which the page says. The @p last one is
     * kept.
     */
    void add(const std::string &series, double at, const Draw &draw, bool last = false);

    /** The same of what is drawn already. */
    void
    add(const std::string &series, const double at, const Drawing &drawing)
    {
      add(series, at, of(drawing));
    }

    /** Before anything is computed: what is in the folder then is of an earlier run, which the page does not show. A
     * run that is killed leaves behind that it has not ended. */
    void begin();

    /** Whether anything is drawn: a model of very many corners is not, which the page says. */
    bool
    draws() const
    {
      return !is_too_large;
    }

    /** Whether the next picture of a series will be kept; if not, it counts as come, and need not be drawn. */
    bool wants(const std::string &series);

    /** What is told of a shape; its parts are increments for an amplitude of one. */
    struct Shape
    {
      std::string           name;           ///< "mode_3"
      unsigned int          number = 0;     ///< in its table, from 1
      std::complex<double>  lambda;         ///< exponent [1/s], or of Floquet ln(multiplier)/T
      double                period = 0;     ///< of Floquet's motion [s]; 0: about an equilibrium
      double                turn   = 0;     ///< of Floquet: phase of the multiplier [rad]
      std::optional<double> speed;          ///< of the model's rotation, where there are several [rad/s]
      bool                  is_main = true; ///< at the speed of modes.csv
    };

    /** A drawing of the state moved by ± ε times the real part of the shape, and by ∓ ε times its imaginary part. */
    using Moved = std::array<Drawing, 4>;

    /** A shape about the state that @p mean draws, at the phase φ by cos φ (moved[0] − moved[1])/2ε + sin φ (moved[2] −
     * moved[3])/2ε. */
    void add_shape(const Shape &shape, const Draw &mean, const Moved &moved, double epsilon);

    /** The same of Floquet, whose parts go along with the motion: one call a picture, in the order of time @p at [s].
     */
    void add_to_shape(const Shape &shape, double at, const Draw &mean, const Moved &moved, double epsilon);

    /** Whether there is room for so many shapes more, of samples as many as the reference has; if not, the page says
     * so. */
    bool has_room_for(std::size_t n_shapes);

    /** Whether the page is watched, and it is time to write it again. */
    bool is_due() const;

    /** Write it if that is so. @p progress, for its head: how far the run is. */
    void watch(const std::string &progress);

    /** Data, messages and the page. @p state: "done", "stopped", "failed"; @p message: of the last two. */
    void write(const std::string &state, const std::string &message);

    /** How often a watched page was written while the run went on, and what part of its time that took; "" if not. */
    std::string cost_of_watching() const;

  private:
    struct Picture
    {
      double             at;
      std::vector<float> motion, rigid, shape; ///< shape: 12 numbers a sample, of Floquet
      std::deque<Field>  fields;
    };

    struct Series
    {
      std::string          name;
      unsigned int         model;      ///< number of what is drawn
      std::size_t          every  = 1; ///< of the pictures that come, one is kept
      std::size_t          n_come = 0, n_other = 0, n_not_finite = 0;
      std::optional<Shape> shape;
      std::vector<Picture> pictures;
    };

    struct StillShape
    {
      Shape              shape;
      unsigned int       model, mean;
      std::vector<float> parts; ///< 12 numbers a sample: displacement and rotation, cosine and sine of each
    };

    const Model                                             &model;
    const bool                                               is_too_large;
    const Drawing                                            reference; ///< empty if the model is too large
    const Log                                               &log;
    std::deque<DrawnModel>                                   models;
    std::vector<Series>                                      series;
    std::vector<StillShape>                                  shapes;
    std::vector<std::pair<unsigned int, std::vector<float>>> means;          ///< what is drawn, and where it is
    WritingPace                                              pace;           ///< of a page that is watched
    GrowingTables                                            tables;         ///< of that
    unsigned int                                             n_left_out = 0; ///< shapes for which there was no room
    std::string                                              log_before;     ///< of the run that this one goes on from

    std::optional<std::filesystem::file_time_type> beginning; ///< of the run; of one that goes on none

    /** JSON: names of the tables in the folder that are older than the run. */
    std::string earlier_tables() const;

    void write_data(const std::string &state, const std::string &message, const std::string &progress);

    /** What of the fields of a series has room in the page, beside so many pictures. */
    enum class Detail
    {
      all,
      sizes,
      few_sizes
    };
    Detail detail_of(const Series &one) const;
    double bytes_of_picture(const Series &one, Detail detail) const;

    /** What is drawn, and the number of its model; none if there are too many models. */
    struct Drawn
    {
      Drawing                     drawing;
      std::optional<unsigned int> model;
    };
    Drawn                       drawn(const Draw &draw, Drawing::Content content);
    std::optional<unsigned int> model_of(const Drawing &drawing);
    Series                     &series_of(const std::string &name, unsigned int model);
    std::string                 json(ArrayStream &stream) const;
    std::string                 json(const Series &one, ArrayStream &stream, std::vector<std::string> &notes) const;
    std::string                 json_of_fields(const Series                    &one,
                                               const std::vector<unsigned int> &kept,
                                               Detail                           detail,
                                               std::vector<std::string>        &partly_known,
                                               ArrayStream                     &stream) const;
    std::vector<unsigned int>   pictures_kept(const Series &one, Detail detail) const;
    void write_all(const std::string &state, const std::string &message, const std::string &progress);
  };
} // namespace samara

#endif
