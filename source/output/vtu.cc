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



  template <typename Number>
  void
  VtuWriter::add_array(const std::string         &attributes,
                       const std::vector<Number> &numbers,
                       const unsigned int         n_components,
                       std::string               &text)
  {
    text += "    <DataArray " + attributes + " format=\"binary\">\n";
    if (!numbers.empty())
      {
        // one block after a header: blocks, size, size of a last partial block, compressed size
        const std::size_t                 n_bytes = numbers.size() * sizeof(Number), n = numbers.size() / n_components;
        const std::vector<unsigned char> &compressed = compressor(numbers.data(), n, n_components * sizeof(Number));
        const std::uint32_t               header[4]  = {1u,
                                                        static_cast<std::uint32_t>(n_bytes),
                                                        static_cast<std::uint32_t>(n_bytes),
                                                        static_cast<std::uint32_t>(compressed.size())};
        add_base64(reinterpret_cast<const unsigned char *>(header), sizeof header, text);
        add_base64(compressed.data(), compressed.size(), text);
      }
    text += "\n    </DataArray>\n";
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



  /** An array with the values of a field, value(i, component) for i < n. */
  template <typename Value>
  void
  VtuWriter::add_field(const std::string              &name,
                       const std::string              &unit,
                       const std::vector<std::string> &components,
                       const std::size_t               n,
                       const Value                    &value,
                       std::string                    &text)
  {
    std::string attributes = "type=\"Float32\" Name=\"" + name + '"';
    if (!components.empty())
      attributes += " NumberOfComponents=\"" + std::to_string(components.size()) + '"';
    for (std::size_t d = 0; d < components.size(); ++d)
      attributes += " ComponentName" + std::to_string(d) + "=\"" + components[d] + '"';
    if (!unit.empty())
      attributes += " units=\"" + unit + '"';
    const std::size_t  n_components = std::max<std::size_t>(components.size(), 1);
    std::vector<float> numbers(n_components * n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t d = 0; d < n_components; ++d)
        numbers[n_components * i + d] = value(i, d);
    add_array(attributes, numbers, n_components, text);
  }



  void
  VtuWriter::add_point_data(const Drawing &drawing, std::string &text)
  {
    const std::size_t n          = drawing.corners.size();
    const auto        of_sample  = [&](const std::size_t i) { return drawing.corners[i].sample; };
    const auto        add_vector = [&](const char *name, const char *unit, Vector3 Sample::*vector) {
      const auto value = [&](const std::size_t i, const std::size_t d) -> float {
        return (drawing.samples[of_sample(i)].*vector)(d);
      };
      add_field(name, unit, inertial_axes, n, value, text);
    };
    text += "  <PointData>\n";
    add_vector("displacement", "m", &Sample::displacement);
    add_vector("velocity", "m/s", &Sample::velocity);
    for (const Field &field : drawing.fields)
      if (!field.is_on_cells)
        {
          AssertThrow(field.end() <= drawing.samples.size(),
                      dealii::ExcMessage("<" + field.name + "> has too many samples."));
          const auto value = [&](const std::size_t i, const std::size_t d) { return field(of_sample(i), d); };
          add_field(field.name, field.unit, field.components, n, value, text);
        }
    const auto object = [&](const std::size_t i, std::size_t) -> float { return drawing.corners[i].object; };
    add_field("object", "", {}, n, object, text);
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
          add_field(field.name, field.unit, field.components, drawing.cells.size(), field, text);
        }
    text += "  </CellData>\n";
  }



  std::string
  VtuWriter::operator()(const Drawing &drawing)
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                       "compressor=\"vtkZLibDataCompressor\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
    text += "<Piece NumberOfPoints=\"" + std::to_string(drawing.corners.size()) + "\" NumberOfCells=\"" +
            std::to_string(drawing.cells.size()) + "\">\n  <Points>\n";
    const auto place = [&](const std::size_t i, const std::size_t d) -> float { return drawing.corners[i].x(d); };
    add_field("Points", "m", inertial_axes, drawing.corners.size(), place, text);
    text += "  </Points>\n";
    add_cells(drawing, text);
    add_point_data(drawing, text);
    add_cell_data(drawing, text);
    return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }
} // namespace samara
