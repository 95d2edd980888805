#include <samara/base/text.h>
#include <samara/output/file.h>
#include <samara/report/report_page.h>
#include <samara/report/write_report.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace samara
{
  namespace
  {
    /** Bytes of pictures in memory, of one series; more are thinned. */
    constexpr double most_in_memory = 6e7;

    /** Bytes of pictures in the page, of one series, and of all shapes, estimated. */
    constexpr double most_of_series = 3e6, most_of_shapes = 2.5e6;

    /** Bytes in the page of a number of two bytes: deflated to two thirds, and three bytes as four letters. */
    constexpr double bytes_of_number = 2 * 0.65 * 4 / 3;

    /** Corners that a page draws at most: 300 000 take some megabytes of it, and a second of a browser. */
    constexpr std::size_t most_corners = 300000;

    /** Different sets of objects that are drawn; a run that has more of them shows the first. */
    constexpr unsigned int most_models = 16;

    /** Fields of a large model that are shown, and pictures of a motion that are worth more than components. */
    constexpr std::size_t few_fields = 12, enough_pictures = 30;



    /** Of at most @p most fields, with or without components. */
    std::size_t
    n_numbers(const std::deque<Field> &fields, const bool with_components = true, std::size_t most = -1)
    {
      std::size_t sum = 0;
      for (const Field &field : fields)
        if (most-- > 0)
          sum += std::size_t(field.end()) * (with_components ? field.n_components() : 1);
      return sum;
    }



    /**
     * Velocity and angular velocity of samples, in a motion also where it begins at rest, as fields; and those of the
     * drawing, which loses them.
     */
    std::deque<Field>
    fields_of(Drawing &drawing, const bool is_motion)
    {
      std::deque<Field> fields;
      const auto        add = [&](const char *name, const char *unit, Vector3 Sample::*vector) {
        Field &field = fields.emplace_back(name, unit, inertial_axes, false);
        bool   moves = is_motion;
        for (unsigned int s = 0; s < drawing.samples.size(); ++s)
          {
            field.set(s, Vector3(drawing.samples[s].*vector));
            moves = moves || !(drawing.samples[s].*vector).isZero(0.);
          }
        if (!moves)
          fields.pop_back();
      };
      add("velocity", "m/s", &Sample::velocity);
      add("angular velocity", "rad/s", &Sample::spin);
      for (Field &field : drawing.fields)
        if (!field.is_on_cells)
          fields.push_back(std::move(field));
      return fields;
    }



    /** Displacement and rotation of each sample per unit of amplitude, in phase and behind it. */
    std::vector<float>
    parts_of(const std::array<Drawing, 4> &moved, const double epsilon)
    {
      std::vector<float> parts;
      parts.reserve(12 * moved[0].samples.size());
      for (unsigned int s = 0; s < moved[0].samples.size(); ++s)
        {
          std::array<Vector3, 2> u, phi;
          for (unsigned int k = 0; k < 2; ++k)
            {
              const Sample &plus = moved[2 * k].samples[s], &minus = moved[2 * k + 1].samples[s];
              const Matrix3 R = plus.D * minus.D.transpose();
              u[k]            = (plus.x - minus.x) / (2 * epsilon);
              phi[k]          = Vector3(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)) / (4 * epsilon);
            }
          for (const Vector3 &v : {u[0], u[1], phi[0], phi[1]})
            for (unsigned int d = 0; d < 3; ++d)
              parts.push_back(static_cast<float>(v(d)));
        }
      return parts;
    }



    std::string
    json_of(const ReportPage::Shape &shape)
    {
      return "\"number\":" + std::to_string(shape.number) + ",\"growth\":" + json_number(shape.lambda.real()) +
             ",\"imaginary\":" + json_number(shape.lambda.imag()) +
             ",\"frequency\":" + json_number(std::abs(shape.lambda)) + ",\"period\":" + json_number(shape.period) +
             ",\"phase\":" + json_number(shape.turn) +
             (shape.speed ? ",\"speed\":" + json_number(*shape.speed) : std::string()) +
             ",\"main\":" + (shape.is_main ? "true" : "false");
    }



    bool
    all_finite(const std::vector<float> &numbers)
    {
      return std::all_of(numbers.begin(), numbers.end(), [](const float x) { return std::isfinite(x); });
    }
  } // namespace



  ReportPage::ReportPage(const Settings &settings, const Model &model, Drawing &&reference, const Log &log)
    : settings(settings)
    , model(model)
    , is_too_large(settings.is_too_large || reference.corners.size() > most_corners)
    , reference(is_too_large ? Drawing() : std::move(reference))
    , log(log)
  {
    if (settings.goes_on)
      {
        std::ifstream     in(settings.folder + "/run.log");
        std::stringstream text;
        text << in.rdbuf();
        log_before = text.str();
      }
  }



  void
  ReportPage::begin()
  {
    std::error_code ignored;
    const auto      now = std::filesystem::last_write_time(settings.folder + "/used.prm", ignored);
    if (!ignored && !settings.goes_on)
      beginning = now;
    write_data("running", "", "");
  }



  std::string
  ReportPage::earlier_tables() const
  {
    std::vector<std::string> names;
    std::error_code          ignored;
    if (beginning)
      for (const auto &entry : std::filesystem::directory_iterator(settings.folder, ignored))
        if (entry.path().extension() == ".csv" && entry.last_write_time(ignored) < *beginning)
          names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    std::string text;
    for (const auto &name : names)
      text += (text.empty() ? "" : ",") + json_text(name);
    return "[" + text + "]";
  }



  std::optional<unsigned int>
  ReportPage::model_of(const Drawing &drawing)
  {
    for (unsigned int i = 0; i < models.size(); ++i)
      if (models[i].fits(drawing))
        return i;
    if (is_too_large || drawing.samples.empty() || models.size() == most_models || !drawing.has_corners())
      return {};
    models.emplace_back(model, drawing, reference);
    return models.size() - 1;
  }



  ReportPage::Drawn
  ReportPage::drawn(const Draw &draw, const Drawing::Content content)
  {
    if (is_too_large)
      return {Drawing(), {}};
    Drawing drawing = draw(content);
    if (const auto which = model_of(drawing); which || models.size() == most_models)
      return {std::move(drawing), which};
    // the first of its kind: corners are needed once
    const Drawing whole = draw(Drawing::Content::everything);
    return {std::move(drawing), model_of(whole)};
  }



  ReportPage::Series &
  ReportPage::series_of(const std::string &name, const unsigned int model)
  {
    for (Series &one : series)
      if (one.name == name)
        return one;
    series.emplace_back();
    series.back().name  = name;
    series.back().model = model;
    return series.back();
  }



  void
  ReportPage::add(const std::string &name, const double at, const Draw &draw, const bool last)
  {
    auto [drawing, which] = drawn(draw, Drawing::Content::samples);
    if (!which)
      return;
    Series &one = series_of(name, *which);
    if (one.model != *which)
      {
        ++one.n_other;
        return;
      }
    if (one.n_come++ % one.every != 0 && !last)
      return;
    Picture picture{at, models[*which].motion(drawing), models[*which].rigid_motions(drawing), {}, fields_of(drawing, name == "dynamic")};
    if (!all_finite(picture.motion) || !all_finite(picture.rigid))
      {
        ++one.n_not_finite;
        return;
      }
    const double bytes = 4. * (picture.motion.size() + picture.rigid.size() + n_numbers(picture.fields));
    one.pictures.push_back(std::move(picture));
    const std::size_t most = std::max(3., std::min(2. * settings.n_pictures + 1, most_in_memory / bytes));
    if (one.pictures.size() <= most)
      return;
    for (std::size_t i = 0; 2 * i < one.pictures.size(); ++i)
      if (i > 0)
        std::swap(one.pictures[i], one.pictures[2 * i]);
    one.pictures.erase(one.pictures.begin() + (one.pictures.size() + 1) / 2, one.pictures.end());
    one.every *= 2;
  }



  bool
  ReportPage::wants(const std::string &name)
  {
    if (is_too_large)
      return false;
    for (Series &one : series)
      if (one.name == name && one.n_come % one.every != 0)
        {
          ++one.n_come;
          return false;
        }
    return true;
  }



  bool
  ReportPage::has_room_for(const std::size_t n_shapes)
  {
    std::size_t n = 0;
    for (const StillShape &shape : shapes)
      n += shape.parts.size();
    const bool has_room =
      !is_too_large && bytes_of_number * (n + 12. * reference.samples.size() * n_shapes) <= most_of_shapes;
    n_left_out += has_room ? 0 : 1;
    return has_room;
  }



  void
  ReportPage::add_shape(const Shape &shape, const Draw &draw_mean, const Moved &moved, const double epsilon)
  {
    const auto [mean, drawn_model] = drawn(draw_mean, Drawing::Content::places);
    const auto which               = drawn_model; // structured bindings cannot be captured
    if (!which || std::any_of(moved.begin(), moved.end(), [&](const Drawing &d) { return !models[*which].fits(d); }))
      return;
    const std::vector<float> parts = parts_of(moved, epsilon), where = models[*which].motion(mean);
    if (!all_finite(parts) || !all_finite(where))
      return;
    if (means.empty() || means.back().first != *which || means.back().second != where)
      means.emplace_back(*which, where);
    shapes.push_back({shape, *which, static_cast<unsigned int>(means.size() - 1), parts});
  }



  void
  ReportPage::add_to_shape(const Shape &shape,
                           const double at,
                           const Draw  &draw_mean,
                           const Moved &moved,
                           const double epsilon)
  {
    const auto [mean, drawn_model] = drawn(draw_mean, Drawing::Content::places);
    const auto which               = drawn_model;
    if (!which || std::any_of(moved.begin(), moved.end(), [&](const Drawing &d) { return !models[*which].fits(d); }))
      return;
    Series &one = series_of(shape.name, *which);
    one.shape   = shape;
    Picture picture{at, models[*which].motion(mean), models[*which].rigid_motions(mean), parts_of(moved, epsilon), {}};
    if (one.model == *which && all_finite(picture.motion) && all_finite(picture.shape))
      one.pictures.push_back(std::move(picture));
  }



  bool
  ReportPage::is_due() const
  {
    if (!settings.watch)
      return false;
    // the clock of the processor costs more to read
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    return pace.may_be_due(wall) && pace.is_due(WritingPace::Time::now());
  }



  void
  ReportPage::watch(const std::string &progress)
  {
    if (!is_due())
      return;
    const WritingPace::Time begin = WritingPace::Time::now();
    write_all("running", "", progress);
    pace.wrote(begin, WritingPace::Time::now());
  }



  std::string
  ReportPage::cost_of_watching() const
  {
    if (!settings.watch || pace.n == 0)
      return "";
    std::ostringstream text;
    text << "the watched page was written " << pace.n
         << " times while the run went on: " << number_to_text("%.3g", pace.spent) << " s of the processor, "
         << number_to_text("%.2g", 100 * pace.spent / std::max(WritingPace::Time::now().processor, 1e-3))
         << " % of the run's";
    return text.str();
  }



  void
  ReportPage::write(const std::string &state, const std::string &message)
  {
    write_all(state, message, "");
  }



  void
  ReportPage::write_data(const std::string &state, const std::string &message, const std::string &progress)
  {
    ArrayStream stream;
    std::string head =
      "{\"state\":" + json_text(state) + ",\"message\":" + json_text(message) + ",\"progress\":" + json_text(progress);
    if (state == "running") // equal runs leave equal data behind
      head += ",\"written\":" + std::to_string(std::time(nullptr)) + ",\"period\":" + json_number(pace.period());
    head += ",\"earlier\":" + earlier_tables() + "," + json(stream) + "}";
    write_report_data(settings.folder, head, stream);
    replace_file(settings.folder + "/run.log", log_before + log.text() + (message.empty() ? "" : message + "\n"));
  }



  void
  ReportPage::write_all(const std::string &state, const std::string &message, const std::string &progress)
  {
    write_data(state, message, progress);
    write_report({settings.folder},
                 settings.folder + "/report.html",
                 state == "running",
                 settings.watch ? &tables : nullptr);
  }



  std::string
  ReportPage::json(ArrayStream &stream) const
  {
    std::string              text = "\"models\":[";
    std::vector<std::string> notes;
    for (const DrawnModel &one : models)
      text += (&one == &models.front() ? "" : ",") + one.json(stream);
    text += "],\"means\":[";
    for (const auto &[which, where] : means)
      text += (&where == &means.front().second ? "" : ",") + stream.add(where, {where.size() / 7, 7});
    text += "],\"shows\":[";
    std::vector<std::string> shows;
    for (const Series &one : series)
      if (!one.pictures.empty())
        shows.push_back(json(one, stream, notes));
    for (const StillShape &one : shapes)
      shows.push_back("{\"name\":" + json_text(one.shape.name) + ",\"kind\":\"shape\",\"model\":" +
                      std::to_string(one.model) + ",\"mean\":" + std::to_string(one.mean) + "," + json_of(one.shape) +
                      ",\"parts\":" + stream.add_packed(one.parts, one.parts.size() / 12, 12) + "}");
    for (std::size_t i = 0; i < shows.size(); ++i)
      text += (i > 0 ? "," : "") + shows[i];
    if (is_too_large)
      notes.push_back("the model is too large to be drawn here");
    else if (n_left_out > 0)
      notes.push_back(std::to_string(n_left_out) + " modes are not drawn, so that the page stays small");
    text += "],\"notes\":[";
    for (std::size_t i = 0; i < notes.size(); ++i)
      text += (i > 0 ? "," : "") + json_text(notes[i]);
    return text + "]";
  }



  double
  ReportPage::bytes_of_picture(const Series &one, const Detail detail) const
  {
    const Picture &last = one.pictures.back();
    return bytes_of_number *
           (last.motion.size() + last.rigid.size() + last.shape.size() +
            n_numbers(last.fields, detail == Detail::all, detail == Detail::few_sizes ? few_fields : -1));
  }



  ReportPage::Detail
  ReportPage::detail_of(const Series &one) const
  {
    if (settings.fields != "automatic")
      return settings.fields == "all" ? Detail::all : Detail::sizes;
    for (const Detail detail : {Detail::all, Detail::sizes})
      if (const std::size_t n = pictures_kept(one, detail).size();
          n >= std::min(one.pictures.size(), enough_pictures) && n * bytes_of_picture(one, detail) <= most_of_series)
        return detail;
    return Detail::few_sizes;
  }



  std::vector<unsigned int>
  ReportPage::pictures_kept(const Series &one, const Detail detail) const
  {
    const double bytes = bytes_of_picture(one, detail), most = settings.watch ? most_of_series / 2 : most_of_series;
    std::size_t  n = one.pictures.size(), stride = 1;
    while (n > 2 && (n / stride + 2) * bytes > most && stride < n)
      stride *= 2;
    if (one.name == "dynamic")
      while ((n - 1) / stride > settings.n_pictures)
        stride *= 2;
    std::vector<unsigned int> kept;
    for (std::size_t i = 0; i < n; i += stride)
      kept.push_back(i);
    if (kept.back() != n - 1)
      kept.push_back(n - 1);
    return kept;
  }



  std::string
  ReportPage::json_of_fields(const Series                    &one,
                             const std::vector<unsigned int> &kept,
                             const Detail                     detail,
                             std::vector<std::string>        &partly_known,
                             ArrayStream                     &stream) const
  {
    std::string text;
    std::size_t room = detail == Detail::few_sizes ? few_fields : -1;
    for (const Field &field : one.pictures[kept.back()].fields)
      {
        if (room-- == 0)
          break;
        // known where it is in all pictures
        const unsigned int         c       = field.n_components();
        const bool                 is_size = detail != Detail::all && c > 1;
        std::vector<const Field *> of_pictures;
        for (const unsigned int k : kept)
          for (const Field &other : one.pictures[k].fields)
            if (other.name == field.name && other.components == field.components)
              of_pictures.push_back(&other);
        if (of_pictures.size() != kept.size())
          {
            partly_known.push_back(field.name);
            continue;
          }
        std::vector<std::uint32_t> known;
        for (unsigned int s = 0; s < models[one.model].n_samples(); ++s)
          if (std::all_of(of_pictures.begin(), of_pictures.end(), [&](const Field *f) {
                for (unsigned int d = 0; d < c; ++d)
                  if (!std::isfinite((*f)(s, d)))
                    return false;
                return true;
              }))
            known.push_back(s);
        if (known.empty())
          continue;
        std::vector<float> values;
        values.reserve(kept.size() * known.size() * (is_size ? 1 : c));
        for (const Field *f : of_pictures)
          for (const std::uint32_t s : known)
            {
              double squares = 0;
              for (unsigned int d = 0; d < c; ++d)
                {
                  if (!is_size)
                    values.push_back((*f)(s, d));
                  squares += double((*f)(s, d)) * (*f)(s, d);
                }
              if (is_size)
                values.push_back(static_cast<float>(std::sqrt(squares)));
            }
        const bool is_still = std::all_of(values.begin(), values.end(), [](const float x) { return x == 0; });
        if (is_still && (field.name == "velocity" || field.name == "angular velocity"))
          continue;
        std::string components;
        for (const auto &name : field.components)
          if (!is_size)
            components += (components.empty() ? "" : ",") + json_text(name);
        text += (text.empty() ? "{" : ",{") + ("\"name\":" + json_text(field.name)) +
                ",\"unit\":" + json_text(field.unit) + ",\"components\":[" + components +
                "],\"known\":" + stream.add(known, {known.size()}) +
                ",\"values\":" + stream.add_packed(values, kept.size(), known.size() * (is_size ? 1 : c)) + "}";
      }
    return text;
  }



  std::string
  ReportPage::json(const Series &one, ArrayStream &stream, std::vector<std::string> &notes) const
  {
    const Detail                    detail = detail_of(one);
    const std::vector<unsigned int> kept   = pictures_kept(one, detail);
    const std::size_t               n = models[one.model].n_samples(), n_objects = models[one.model].n_objects();
    std::vector<double>             times;
    std::vector<float>              places, turns, rigid, shape;
    for (const unsigned int k : kept)
      {
        const Picture    &picture = one.pictures[k];
        const std::size_t before  = turns.size();
        times.push_back(picture.at);
        for (std::size_t s = 0; s < n; ++s)
          {
            const float *const of_sample = &picture.motion[7 * s];
            places.insert(places.end(), of_sample, of_sample + 3);
            // q and −q are the same turn: the one nearer to the last picture
            float dot = 1;
            if (before > 0)
              {
                dot = 0;
                for (unsigned int i = 0; i < 4; ++i)
                  dot += of_sample[3 + i] * turns[before - 4 * n + 4 * s + i];
              }
            for (unsigned int i = 0; i < 4; ++i)
              turns.push_back(dot < 0 ? -of_sample[3 + i] : of_sample[3 + i]);
          }
        rigid.insert(rigid.end(), picture.rigid.begin(), picture.rigid.end());
        shape.insert(shape.end(), picture.shape.begin(), picture.shape.end());
      }
    if (const std::size_t n_all = one.n_come; n_all > kept.size() && one.every * kept.size() < n_all)
      notes.push_back(one.name + ": " + std::to_string(kept.size()) + " of " + std::to_string(n_all) +
                      " pictures are kept, so that the page stays small");
    if (one.n_other > 0)
      notes.push_back(one.name + ": " + std::to_string(one.n_other) +
                      " pictures have other objects than the first and are not shown");
    if (detail != Detail::all && settings.fields == "automatic")
      notes.push_back(one.name + ": of the fields only sizes are kept" +
                      (detail == Detail::few_sizes && one.pictures.back().fields.size() > few_fields ?
                         ", and of the first " + std::to_string(few_fields) + " of them" :
                         std::string()) +
                      ", so that the page stays small; <Output / Report fields = all> keeps all components");
    std::vector<std::string> partly_known;
    const std::string        fields = json_of_fields(one, kept, detail, partly_known, stream);
    if (!partly_known.empty())
      notes.push_back(one.name + ": not shown, since not known in all pictures: " + join(partly_known, ", "));
    if (one.n_not_finite > 0)
      notes.push_back(one.name + ": " + std::to_string(one.n_not_finite) +
                      " pictures have places that are no finite numbers and are not shown");
    return "{\"name\":" + json_text(one.name) + ",\"kind\":\"" + (one.shape ? "floquet" : "frames") +
           "\",\"model\":" + std::to_string(one.model) + (one.shape ? "," + json_of(*one.shape) : std::string()) +
           ",\"times\":" + stream.add(times, {times.size()}) +
           ",\"places\":" + stream.add_packed(places, kept.size(), 3 * n, models[one.model].steps_of_places()) +
           ",\"turns\":" + stream.add_packed(turns, kept.size(), 4 * n, models[one.model].steps_of_turns()) +
           ",\"rigid\":" + stream.add(rigid, {kept.size(), n_objects, 7}) +
           (one.shape ? ",\"parts\":" + stream.add_packed(shape, kept.size(), 12 * n) : std::string()) +
           ",\"fields\":[" + fields + "]}";
  }
} // namespace samara
