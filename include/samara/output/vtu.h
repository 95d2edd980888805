#ifndef samara_output_vtu_h
#define samara_output_vtu_h

#include <samara/model/drawing.h>

#include <string>

namespace samara
{
  /**
   * The content of a .vtu file of VTK (UnstructuredGrid, version 0.1) that shows a drawing: its points with the fields
   * of their samples as 32-bit numbers, its quadrilaterals, and the number of the object each point belongs to. Arrays
   * are compressed by zlib and written as base64 between the tags, a form that all readers understand.
   *
   * Vectors have inertial components; strains and curvatures those of the section. Names and units: displacement [m],
   * section force [N], section moment [N m], strain [1], curvature [1/m], velocity [m/s], object.
   *
   * @throws std::runtime_error if zlib fails (no memory).
   */
  std::string vtu_of(const Drawing &drawing);
} // namespace samara

#endif
