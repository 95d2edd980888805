/*
 * Problem:   pictures of a box, a bar, a panel, a wire and a point
 * Reference: the files hold what was drawn, decoded as the VTK file formats document says: base64 of the numbers
 *            (blocks, size of a block, size of the last, compressed sizes), then base64 of the blocks of zlib.
 */

#include <samara/output/pictures.h>

#include <cmath>
#include <cstdint>
#include <filesystem>

#include "scratch_folder.h"
#include "vtu_arrays.h"

using namespace samara;

namespace
{
  Drawing
  two_objects()
  {
    Sample a, b;
    a.x = b.x      = {1, 2, 3};
    a.displacement = {0.5, 0, 0.25};
    b.displacement = {-1, -2, -3};
    b.x(0) += 1;

    Drawing drawing;
    drawing.begin_object("fuselage");
    drawing.box(a, {1, 1, 1});
    drawing.begin_object("blade 1");
    drawing.bar(a, b, 0.125);

    drawing.begin_object("panel");
    const Drawing::Place panel    = drawing.grid(3, 2, {a, b, a, b, a, b});
    Field               &pressure = drawing.field("pressure", "Pa");
    Field               &flux     = drawing.field("flux", "N/m", {"11", "22", "12"}, true);
    for (unsigned int i = 0; i < 6; ++i)
      pressure.set(panel.first_sample + i, 100. + i);
    for (unsigned int i = 0; i < 2; ++i)
      flux.set(panel.first_cell + i, Vector3(i, 10, 1e60));
    drawing.begin_object("wire");
    drawing.grid(2, 1, {a, b});
    drawing.begin_object("mark");
    drawing.grid(1, 1, {b});
    return drawing;
  }
} // namespace



TEST(Pictures, PictureHoldsWhatWasDrawn)
{
  const ScratchFolder folder;
  const Drawing       drawing = two_objects();
  Pictures(folder.path, "static").add(two_objects(), 0.5);

  const std::string text = content_of(folder.path + "/pictures/static.0000.vtu");
  EXPECT_EQ(attribute(text, "<VTKFile", "type"), "UnstructuredGrid");
  EXPECT_EQ(attribute(text, "<Piece", "NumberOfCells"), std::to_string(drawing.cells.size()));
  EXPECT_EQ(attribute(text, "<Piece", "NumberOfPoints"), std::to_string(drawing.corners.size()));
  for (const char *name : {"displacement", "velocity", "flux"})
    EXPECT_NE(text.find("Name=\"" + std::string(name) + "\" NumberOfComponents=\"3\""), std::string::npos) << name;
  EXPECT_NE(text.find("</VTKFile>"), std::string::npos);

  const auto displacement = numbers_of<float>(text, "displacement");
  const auto object       = numbers_of<float>(text, "object");
  const auto connectivity = numbers_of<std::int32_t>(text, "connectivity");
  ASSERT_EQ(displacement.size(), 3 * drawing.corners.size());
  const auto offsets = numbers_of<std::int32_t>(text, "offsets");
  const auto kinds   = numbers_of<std::uint8_t>(text, "types");
  const auto places  = numbers_of<float>(text, "Points");
  ASSERT_EQ(offsets.size(), drawing.cells.size());
  ASSERT_EQ(kinds.size(), drawing.cells.size());
  ASSERT_EQ(connectivity.size(), std::size_t(offsets.back()));

  std::int32_t begin = 0;
  for (unsigned int q = 0; q < drawing.cells.size(); begin = offsets[q++])
    for (unsigned int c = 0; c < drawing.cells[q].n_corners(); ++c)
      {
        const unsigned int     point  = connectivity[begin + c];
        const Drawing::Corner &corner = drawing.corners[drawing.cells[q].corners[c]];
        EXPECT_EQ(point, drawing.cells[q].corners[c]);
        EXPECT_EQ(object[point], corner.object);
        EXPECT_EQ(kinds[q], drawing.cells[q].dimension == 2 ? 9 : drawing.cells[q].dimension == 1 ? 3 : 1);
        for (unsigned int d = 0; d < 3; ++d)
          {
            EXPECT_FLOAT_EQ(places[3 * point + d], corner.x(d));
            EXPECT_FLOAT_EQ(displacement[3 * point + d], drawing.samples[corner.sample].displacement(d));
          }
      }
}



/** Also where an object does not have a field, and where 32 bits do not hold a number: no zero must stand for either.
 */
TEST(Pictures, FieldsAreWrittenWithUnitsAndComponents)
{
  const ScratchFolder folder;
  const Drawing       drawing = two_objects();
  Pictures(folder.path, "static").add(two_objects(), 0);
  const std::string text = content_of(folder.path + "/pictures/static.0000.vtu");

  EXPECT_TRUE(contains(text, "Name=\"pressure\" units=\"Pa\""));
  EXPECT_TRUE(contains(text,
                       "Name=\"flux\" NumberOfComponents=\"3\" ComponentName0=\"11\" ComponentName1=\"22\" "
                       "ComponentName2=\"12\" units=\"N/m\""));
  EXPECT_LT(text.find("<PointData>"), text.find("\"pressure\""));
  EXPECT_LT(text.find("<CellData>"), text.find("\"flux\""));

  const auto pressure = numbers_of<float>(text, "pressure"), flux = numbers_of<float>(text, "flux");
  ASSERT_EQ(pressure.size(), drawing.corners.size());
  ASSERT_EQ(flux.size(), 3 * drawing.cells.size());
  const auto   is_panel = [&](const Drawing::Corner &corner) { return drawing.objects[corner.object] == "panel"; };
  unsigned int n        = 0;
  for (unsigned int i = 0; i < pressure.size(); ++i)
    if (is_panel(drawing.corners[i]))
      EXPECT_EQ(pressure[i], 100.f + n++);
    else
      EXPECT_TRUE(std::isnan(pressure[i]));
  EXPECT_EQ(n, 6u);
  n = 0;
  for (unsigned int i = 0; i < drawing.cells.size(); ++i)
    if (is_panel(drawing.corners[drawing.cells[i].corners[0]]))
      {
        EXPECT_EQ(flux[3 * i], float(n++));
        EXPECT_EQ(flux[3 * i + 1], 10.f);
        EXPECT_TRUE(std::isinf(flux[3 * i + 2]));
      }
    else
      EXPECT_TRUE(std::isnan(flux[3 * i]));
  EXPECT_EQ(n, 2u);
}



TEST(Pictures, SeriesIsCompleteAfterEachPicture)
{
  const ScratchFolder folder;
  Pictures            pictures(folder.path, "dynamic");
  EXPECT_FALSE(std::filesystem::exists(folder.path + "/dynamic.pvd"));

  for (unsigned int frame = 0; frame < 3; ++frame)
    {
      pictures.add(two_objects(), 0.25 * frame);
      pictures.finish();
      const std::string text = content_of(folder.path + "/dynamic.pvd");
      const std::string file = "pictures/dynamic.000" + std::to_string(frame) + ".vtu";
      EXPECT_NE(text.find("file=\"" + file + "\""), std::string::npos) << text;
      EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
      EXPECT_TRUE(std::filesystem::exists(folder.path + "/" + file));
      EXPECT_EQ(attribute(text.substr(text.rfind("<DataSet")), "<DataSet", "timestep"),
                std::vector<std::string>({"0", "0.25", "0.5"})[frame]);
    }
  // nobody has said of what kind these are
  EXPECT_EQ(
    content_of(folder.path + "/dynamic.objects.txt"),
    "object\tname\tsubsection\tkind\n0\tfuselage\t\t\n1\tblade 1\t\t\n2\tpanel\t\t\n3\twire\t\t\n4\tmark\t\t\n");
}



TEST(Pictures, SeriesIsWrittenAtTheFirstPictureAndAtTheEnd)
{
  const ScratchFolder folder;
  const auto          n_named = [&]() {
    const std::string text = content_of(folder.path + "/dynamic.pvd");
    unsigned int      n    = 0;
    for (std::size_t at = text.find("<DataSet"); at != std::string::npos; at = text.find("<DataSet", at + 1))
      ++n;
    return n;
  };
  {
    Pictures pictures(folder.path, "dynamic");
    for (unsigned int frame = 0; frame < 20; ++frame)
      {
        pictures.add(two_objects(), frame);
        EXPECT_GE(n_named() + (frame == 0), 1u); // the one before is written
      }
  }
  EXPECT_EQ(n_named(), 20u);
}



TEST(Pictures, NothingToDrawIsAPictureToo)
{
  const ScratchFolder folder;
  Pictures(folder.path, "empty").add(Drawing(), 0);
  EXPECT_EQ(attribute(content_of(folder.path + "/pictures/empty.0000.vtu"), "<Piece", "NumberOfCells"), "0");
}



TEST(Pictures, FolderThatCannotBeMadeIsNamed)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/file";
  std::ofstream(file) << "in the way";

  const std::string complaint = complaint_of([&] { Pictures(file, "static"); });
  EXPECT_NE(complaint.find("cannot write " + file), std::string::npos) << complaint;
}



/** The folder is lost while the program runs; this works for the superuser too, whom permissions do not stop. */
TEST(Pictures, PictureThatCannotBeWrittenIsNamed)
{
  const ScratchFolder folder;
  Pictures            pictures(folder.path, "static");
  std::filesystem::remove_all(folder.path);

  const std::string complaint = complaint_of([&] {
    pictures.add(two_objects(), 0);
    pictures.finish();
  });
  EXPECT_NE(complaint.find(folder.path + "/pictures/static.0000.vtu"), std::string::npos) << complaint;
}
