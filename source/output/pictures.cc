#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/item.h>
#include <samara/output/file.h>
#include <samara/output/pictures.h>
#include <samara/output/vtu.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace samara
{
  namespace
  {
    constexpr std::chrono::seconds between_series(1);

    /** 7 becomes pictures/NAME.0007.vtu, so that files in the order of their names are in the order of time. */
    std::string
    picture_file(const std::string &name, const unsigned int frame)
    {
      std::ostringstream text;
      text << "pictures/" << name << "." << std::setw(4) << std::setfill('0') << frame << ".vtu";
      return text.str();
    }



    /** The value of an attribute of the XML tag on this line; "" if it has none. */
    std::string
    attribute(const std::string &line, const std::string &name)
    {
      const std::string begin = " " + name + "=\"";
      const std::size_t at    = line.find(begin);
      if (at == std::string::npos)
        return "";
      return line.substr(at + begin.size(), line.find('"', at + begin.size()) - at - begin.size());
    }
  } // namespace



  Pictures::Pictures(const std::string &folder, const std::string &name, const std::optional<double> &resume_after)
    : folder(folder)
    , name(name)
  {
    make_folder(folder + "/pictures");
    if (resume_after && std::filesystem::exists(folder + "/" + name + ".pvd"))
      keep_series(*resume_after);
  }



  void
  Pictures::keep_series(const double resume_after)
  {
    const std::string file = folder + "/" + name + ".pvd";
    std::ifstream     in(file);
    bool              ours = false;
    for (std::string line; std::getline(in, line);)
      {
        if (line.find("<DataSet ") == std::string::npos)
          continue;
        double            time    = 0;
        const std::string picture = attribute(line, "file");
        ours =
          text_to_number(attribute(line, "timestep"), time) && picture == picture_file(name, times_and_files.size());
        if (!ours || !is_up_to(time, resume_after))
          break;
        times_and_files.emplace_back(time, picture);
      }
    if (!ours)
      throw InputError(file + " is not a series of pictures that samara wrote, so that the run cannot be continued in "
                              "it. Remove the file, or start without --restart.");
    write_series();
  }



  void
  Pictures::add(Drawing &&drawing, const double time)
  {
    wait();
    being_written =
      std::async(std::launch::async, [this, time, drawing = std::move(drawing)] { write(drawing, time); });
  }



  Pictures::~Pictures()
  {
    try
      {
        finish();
      }
    catch (const std::exception &)
      {
        // whoever wants to know calls finish()
      }
  }



  void
  Pictures::finish()
  {
    wait();
    if (n_in_series < times_and_files.size())
      write_series();
  }



  void
  Pictures::wait()
  {
    if (being_written.valid())
      being_written.get();
  }



  void
  Pictures::write(const Drawing &drawing, const double time)
  {
    const std::string file = picture_file(name, times_and_files.size());
    replace_file(folder + "/" + file, vtu_of(drawing));
    write_objects(drawing);

    times_and_files.emplace_back(time, file);
    if (n_in_series == 0 || std::chrono::steady_clock::now() - time_of_series > between_series)
      write_series();
  }



  void
  Pictures::write_objects(const Drawing &drawing)
  {
    if (drawing.objects == written_objects)
      return;

    std::string content = "object\tname\tsubsection\tkind\n";
    for (unsigned int i = 0; i < drawing.objects.size(); ++i)
      {
        const Item *const item = i < drawing.items.size() ? drawing.items[i] : nullptr;
        content += std::to_string(i) + "\t" + drawing.objects[i] + "\t" + (item != nullptr ? item->subsection : "") +
                   "\t" + (item != nullptr ? item->kind : "") + "\n";
      }
    replace_file(folder + "/" + name + ".objects.txt", content);
    written_objects = drawing.objects;
  }



  void
  Pictures::write_series()
  {
    std::string content = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (const auto &[time, file] : times_and_files)
      content += "    <DataSet timestep=\"" + number_to_field(time, digits_of_records) +
                 "\" group=\"\" part=\"0\" file=\"" + file + "\"/>\n";
    content += "  </Collection>\n</VTKFile>\n";
    replace_file(folder + "/" + name + ".pvd", content);
    n_in_series    = times_and_files.size();
    time_of_series = std::chrono::steady_clock::now();
  }
} // namespace samara
