#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/output/file.h>
#include <samara/output/pictures.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <tuple>

namespace samara
{
  namespace
  {
    struct Field
    {
      const char *name, *unit;
      Vector3 Sample::*value;
    };

    const Field vector_fields[] = {{"displacement", "m", &Sample::displacement},
                                   {"section force", "N", &Sample::force},
                                   {"section moment", "N m", &Sample::moment},
                                   {"strain", "1", &Sample::strain},
                                   {"curvature", "1/m", &Sample::curvature},
                                   {"velocity", "m/s", &Sample::velocity}};

    using Patch = dealii::DataOutBase::Patch<2, 3>;
    using Range = std::
      tuple<unsigned int, unsigned int, std::string, dealii::DataComponentInterpretation::DataComponentInterpretation>;



    /** What the rows of a patch's data are: three for each vector field, then the number of the object. */
    void
    describe_fields(std::vector<std::string> &names, std::vector<Range> &ranges)
    {
      for (const Field &field : vector_fields)
        {
          ranges.emplace_back(names.size(),
                              names.size() + 2,
                              field.name,
                              dealii::DataComponentInterpretation::component_is_part_of_vector);
          names.insert(names.end(), 3, field.name);
        }
      names.push_back("object");
    }



    Patch
    make_patch(const Drawing::Quad &quad, const unsigned int index, const unsigned int n_rows)
    {
      // Our corners go round the quadrilateral, those of deal.II go line by line.
      constexpr unsigned int corner_of_vertex[4] = {0, 1, 3, 2};

      Patch patch;
      patch.reference_cell = dealii::ReferenceCells::Quadrilateral;
      patch.patch_index    = index;
      patch.n_subdivisions = 1;
      patch.data.reinit(n_rows, 4);
      for (unsigned int v = 0; v < 4; ++v)
        {
          const Sample &sample = quad.corners[corner_of_vertex[v]];
          patch.vertices[v]    = dealii::Point<3>(sample.x(0), sample.x(1), sample.x(2));

          unsigned int row = 0;
          for (const Field &field : vector_fields)
            for (unsigned int d = 0; d < 3; ++d)
              patch.data(row++, v) = static_cast<float>((sample.*field.value)(d));
          patch.data(row, v) = static_cast<float>(quad.object);
        }
      return patch;
    }



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
  Pictures::add(const Drawing &drawing, const double time)
  {
    const std::string file = picture_file(name, times_and_files.size());
    write_picture(folder + "/" + file, drawing);
    write_objects(drawing.objects);

    times_and_files.emplace_back(time, file);
    write_series();
  }



  void
  Pictures::write_picture(const std::string &file, const Drawing &drawing) const
  {
    std::vector<std::string> names;
    std::vector<Range>       ranges;
    describe_fields(names, ranges);

    std::vector<Patch> patches;
    patches.reserve(drawing.quads.size());
    for (const Drawing::Quad &quad : drawing.quads)
      patches.push_back(make_patch(quad, patches.size(), names.size()));

    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false; // equal runs shall leave equal files
    flags.compression_level   = dealii::DataOutBase::VtkFlags::best_speed;
    for (const Field &field : vector_fields)
      flags.physical_units[field.name] = field.unit;

    std::ostringstream content;
    dealii::DataOutBase::write_vtu(patches, names, ranges, flags, content);
    replace_file(file, content.str());
  }



  void
  Pictures::write_objects(const std::vector<std::string> &objects)
  {
    if (objects == written_objects)
      return;

    std::string content;
    for (unsigned int i = 0; i < objects.size(); ++i)
      content += std::to_string(i) + " " + objects[i] + "\n";
    replace_file(folder + "/" + name + ".objects.txt", content);
    written_objects = objects;
  }



  void
  Pictures::write_series() const
  {
    std::string content = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (const auto &[time, file] : times_and_files)
      content += "    <DataSet timestep=\"" + number_to_field(time, digits_of_records) +
                 "\" group=\"\" part=\"0\" file=\"" + file + "\"/>\n";
    content += "  </Collection>\n</VTKFile>\n";
    replace_file(folder + "/" + name + ".pvd", content);
  }
} // namespace samara
