#include <samara/output/vtu.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** VTK's numbers for a point, a line, and a quadrilateral whose corners go round it. */
    constexpr std::uint8_t vtk_kinds[] = {1, 3, 9};



    bool
    are_equal(const std::vector<Drawing::Cell> &a, const std::vector<Drawing::Cell> &b)
    {
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Drawing::Cell &c, const Drawing::Cell &d) {
        return c.dimension == d.dimension && c.corners == d.corners;
      });
    }
  } // namespace



  void
  VtuWriter::add_stream(const std::string                &attributes,
                        const std::size_t                 n_bytes,
                        const std::vector<unsigned char> &compressed,
                        std::string                      &text)
  {
    text += "    <DataArray " + attributes + " format=\"binary\">\n";
    if (n_bytes > 0)
      {
        // one block after a header: blocks, size, size of a last partial block, compressed size
        const std::uint32_t header[4] = {1u,
                                         static_cast<std::uint32_t>(n_bytes),
                                         static_cast<std::uint32_t>(n_bytes),
                                         static_cast<std::uint32_t>(compressed.size())};
        add_base64(reinterpret_cast<const unsigned char *>(header), sizeof header, text);
        add_base64(compressed.data(), compressed.size(), text);
      }
    text += "\n    </DataArray>\n";
  }



  template <typename Number>
  void
  VtuWriter::add_array(const std::string         &attributes,
                       const std::vector<Number> &numbers,
                       const unsigned int         n_components,
                       std::string               &text)
  {
    add_stream(attributes,
               numbers.size() * sizeof(Number),
               compressor(numbers.data(), numbers.size() / n_components, n_components * sizeof(Number)),
               text);
  }



  void
  VtuWriter::add_cells(const Drawing &drawing, std::string &text)
  {
    if (text_of_cells.empty() || !are_equal(cells, drawing.cells))
      {
        std::vector<std::int32_t> connectivity, offsets;
        std::vector<std::uint8_t> kinds;
        for (const auto &cell : drawing.cells)
          {
            connectivity.insert(connectivity.end(), cell.corners.begin(), cell.corners.begin() + cell.n_corners());
            offsets.push_back(connectivity.size());
            kinds.push_back(vtk_kinds[cell.dimension]);
          }
        text_of_cells.clear();
        add_array("type=\"Int32\" Name=\"connectivity\"", connectivity, 1, text_of_cells);
        add_array("type=\"Int32\" Name=\"offsets\"", offsets, 1, text_of_cells);
        add_array("type=\"UInt8\" Name=\"types\"", kinds, 1, text_of_cells);
        cells = drawing.cells;
      }
    text += "  <Cells>\n" + text_of_cells + "  </Cells>\n";
  }



  namespace
  {
    std::string
    attributes_of(const std::string &name, const std::string &unit, const std::vector<std::string> &components)
    {
      std::string attributes = "type=\"Float32\" Name=\"" + name + '"';
      if (!components.empty())
        attributes += " NumberOfComponents=\"" + std::to_string(components.size()) + '"';
      for (std::size_t d = 0; d < components.size(); ++d)
        attributes += " ComponentName" + std::to_string(d) + "=\"" + components[d] + '"';
      if (!unit.empty())
        attributes += " units=\"" + unit + '"';
      return attributes;
    }
  } // namespace



  void
  VtuWriter::find_runs(const Drawing &drawing)
  {
    samples.clear();
    times.clear();
    for (const auto &corner : drawing.corners)
      if (!samples.empty() && samples.back() == corner.sample)
        ++times.back();
      else
        {
          samples.push_back(corner.sample);
          times.push_back(1);
        }
  }



  template <typename Value>
  void
  VtuWriter::add_field_of_samples(const Drawing                  &drawing,
                                  const std::string              &name,
                                  const std::string              &unit,
                                  const std::vector<std::string> &components,
                                  const Value                    &value,
                                  std::string                    &text)
  {
    // from this length of runs on, in the mean, it pays not to write down all corners before they are compressed
    constexpr std::size_t worth_runs = 4, most_components = 16; // values have 64 bytes at most
    const std::size_t     n_components = std::max<std::size_t>(components.size(), 1), n = drawing.corners.size();
    const bool            has_runs = n >= worth_runs * samples.size() && n_components <= most_components;
    numbers.clear();
    numbers.reserve(n_components * (has_runs ? samples.size() : n));
    for (std::size_t i = 0; i < samples.size(); ++i)
      for (unsigned int j = 0; j < (has_runs ? 1 : times[i]); ++j)
        for (std::size_t d = 0; d < n_components; ++d)
          numbers.push_back(value(samples[i], d));
    const std::string attributes = attributes_of(name, unit, components);
    if (has_runs && n > 0)
      add_stream(attributes,
                 n * n_components * sizeof(float),
                 compressor.repeated(numbers.data(), times, n_components * sizeof(float)),
                 text);
    else
      add_array(attributes, numbers, n_components, text);
  }



  void
  VtuWriter::add_points(const Drawing &drawing, std::string &text)
  {
    // where things move they hardly shrink; to find it out costs as much as all fields together
    numbers.clear();
    numbers.reserve(3 * drawing.corners.size());
    for (const auto &corner : drawing.corners)
      for (unsigned int d = 0; d < 3; ++d)
        numbers.push_back(static_cast<float>(corner.x(d)));
    const std::size_t n_bytes = numbers.size() * sizeof(float);
    text += "  <Points>\n";
    add_stream(attributes_of("Points", "m", inertial_axes),
               n_bytes,
               compressor.as_they_are(numbers.data(), n_bytes),
               text);
    text += "  </Points>\n";
  }



  void
  VtuWriter::add_point_data(const Drawing &drawing, std::string &text)
  {
    const auto add_vector = [&](const char *name, const char *unit, Vector3 Sample::*vector) {
      const auto value = [&](const unsigned int sample, const std::size_t d) -> float {
        return (drawing.samples[sample].*vector)(d);
      };
      add_field_of_samples(drawing, name, unit, inertial_axes, value, text);
    };
    find_runs(drawing);
    text += "  <PointData>\n";
    add_vector("displacement", "m", &Sample::displacement);
    add_vector("velocity", "m/s", &Sample::velocity);
    for (const Field &field : drawing.fields)
      if (!field.is_on_cells)
        {
          AssertThrow(field.end() <= drawing.samples.size(),
                      dealii::ExcMessage("<" + field.name + "> has too many samples."));
          add_field_of_samples(drawing, field.name, field.unit, field.components, field, text);
        }
    numbers.clear();
    for (const auto &corner : drawing.corners)
      numbers.push_back(corner.object);
    add_array(attributes_of("object", "", {}), numbers, 1, text);
    text += "  </PointData>\n";
  }



  void
  VtuWriter::add_cell_data(const Drawing &drawing, std::string &text)
  {
    text += "  <CellData>\n";
    for (const Field &field : drawing.fields)
      if (field.is_on_cells)
        {
          AssertThrow(field.end() <= drawing.cells.size(),
                      dealii::ExcMessage("<" + field.name + "> has too many cells."));
          numbers.clear();
          for (std::size_t i = 0; i < drawing.cells.size(); ++i)
            for (unsigned int d = 0; d < field.n_components(); ++d)
              numbers.push_back(field(i, d));
          add_array(attributes_of(field.name, field.unit, field.components), numbers, field.n_components(), text);
        }
    text += "  </CellData>\n";
  }



  std::string
  VtuWriter::operator()(const Drawing &drawing)
  {
    std::string text;
    text.reserve(size_of_last + size_of_last / 16);
    text += "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
            "compressor=\"vtkZLibDataCompressor\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
    text += "<Piece NumberOfPoints=\"" + std::to_string(drawing.corners.size()) + "\" NumberOfCells=\"" +
            std::to_string(drawing.cells.size()) + "\">\n";
    add_points(drawing, text);
    add_cells(drawing, text);
    add_point_data(drawing, text);
    add_cell_data(drawing, text);
    text += "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    size_of_last = text.size();
    return text;
  }
} // namespace samara
