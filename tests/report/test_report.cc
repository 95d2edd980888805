/*
 * Problem:   what the page of a report is made of: arrays, tables, rigid motions of bodies, joints magnified
 * Reference: numbers that were put in; a rotation that was put in; the largest error of two bytes; the geometry of a
 * hinge between a body that is held in two places and one in one place
 */

#include <samara/base/errors.h>
#include <samara/report/csv_columns.h>
#include <samara/report/drawn_model.h>
#include <samara/report/page_sources.h>
#include <samara/report/write_report.h>

#include "../output/scratch_folder.h"
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>

using namespace samara;

namespace
{
  std::string
  inflated(const std::string &deflated, const std::size_t size)
  {
    std::string bytes(size, '\0');
    uLongf      n = size;
    EXPECT_EQ(Z_OK,
              uncompress(reinterpret_cast<Bytef *>(bytes.data()),
                         &n,
                         reinterpret_cast<const Bytef *>(deflated.data()),
                         deflated.size()));
    EXPECT_EQ(size, n);
    return bytes;
  }



  /** Number @p i of @p n numbers whose bytes of equal weight stand together behind @p offset. */
  template <typename Number>
  Number
  number_at(const std::string &bytes, const std::size_t offset, const std::size_t n, const std::size_t i)
  {
    char own[sizeof(Number)];
    for (std::size_t b = 0; b < sizeof(Number); ++b)
      own[b] = bytes[offset + b * n + i];
    Number number;
    std::memcpy(&number, own, sizeof number);
    return number;
  }



  /** The number behind this key of a JSON text. */
  std::size_t
  offset_in(const std::string &json, const std::string &behind = "")
  {
    const std::size_t at = json.find("\"o\":", json.find(behind)) + 4;
    return std::stoul(json.substr(at));
  }



  void
  write(const std::string &file, const std::string &content)
  {
    std::ofstream(file) << content;
  }



  std::vector<std::string>
  names_of(const CsvColumns &table)
  {
    std::vector<std::string> names;
    for (const auto &column : table.columns)
      names.push_back(column.name + "|" + column.unit);
    return names;
  }
} // namespace



TEST(Report, ArraysAreWhatWasPutIn)
{
  ArrayStream               stream;
  const std::vector<double> doubles = {1. / 3, -2e300, 0, 5e-324};
  stream.add(std::vector<float>{1, 2, 3}, {3});
  const std::string json  = stream.add(doubles, {2, 2});
  const std::string bytes = inflated(stream.deflated(), stream.size());
  EXPECT_EQ("{\"k\":\"f8\",\"s\":[2,2],\"o\":12}", json);
  for (unsigned int i = 0; i < doubles.size(); ++i)
    EXPECT_EQ(doubles[i], number_at<double>(bytes, offset_in(json), doubles.size(), i));
}



TEST(Report, TwoBytesLoseEightMillionthsOfTheRange)
{
  ArrayStream        stream;
  const std::size_t  rows = 57, columns = 3;
  std::vector<float> values;
  for (unsigned int r = 0; r < rows; ++r) // of unlike size, and one that does not change
    for (const double v : {1e-3 * std::sin(r), 1e6 + 40. * r * r, -7.25})
      values.push_back(static_cast<float>(v));
  const std::string json  = stream.add_packed(values, rows, columns);
  const std::string bytes = inflated(stream.deflated(), stream.size());
  for (unsigned int c = 0; c < columns; ++c)
    {
      const float low  = number_at<float>(bytes, offset_in(json, "\"low\""), columns, c),
                  step = number_at<float>(bytes, offset_in(json, "\"step\""), columns, c);
      for (unsigned int r = 0; r < rows; ++r)
        {
          const int    q     = number_at<std::int16_t>(bytes, offset_in(json, "\"q\""), rows * columns, c * rows + r);
          const double range = 65535. * step, value = values[r * columns + c];
          EXPECT_NEAR(value, low + double(step) * (q + 32768), 8e-6 * range + 1e-7 * std::abs(value));
        }
    }
}



TEST(Report, AThirdByteWhereTwoAreTooCoarse)
{
  ArrayStream        stream;
  const std::size_t  rows = 1000, columns = 3;
  std::vector<float> values;
  for (unsigned int r = 0; r < rows; ++r) // the first and the last may lose 1e-6, the one between what it likes
    for (const double v : {10 * std::sin(0.01 * r), 10 * std::cos(0.01 * r), 1e-3 * r})
      values.push_back(static_cast<float>(v));
  const std::string json  = stream.add_packed(values, rows, columns, {2e-6F, 1.F, 1e-4F});
  const std::string bytes = inflated(stream.deflated(), stream.size());
  const auto        low   = [&](const unsigned int c) {
    return number_at<float>(bytes, offset_in(json, "\"low\""), columns, c);
  };
  const auto step = [&](const unsigned int c) {
    return number_at<float>(bytes, offset_in(json, "\"step\""), columns, c);
  };
  ASSERT_EQ(0u, number_at<std::uint32_t>(bytes, offset_in(json, "\"of\""), 1, 0));
  EXPECT_NE(std::string::npos, json.find("\"fine\":{\"k\":\"u1\",\"s\":[1,1000]"));
  double largest[3] = {0, 0, 0};
  for (unsigned int c = 0; c < columns; ++c)
    for (unsigned int r = 0; r < rows; ++r)
      {
        double q = number_at<std::int16_t>(bytes, offset_in(json, "\"q\""), rows * columns, c * rows + r) + 32768;
        if (c == 0)
          q += number_at<std::uint8_t>(bytes, offset_in(json, "\"fine\""), rows, r) / 256.;
        largest[c] = std::max(largest[c], std::abs(low(c) + step(c) * q - values[r * columns + c]));
      }
  EXPECT_LT(largest[0], 1e-6); // a 256th of 20 / 65535 / 2, and the rounding of single precision
  EXPECT_LT(largest[1], 1.6e-4);
  EXPECT_GT(largest[1], 1e-4);
  EXPECT_LT(largest[2], 8e-6);
}



TEST(Report, NoiseBetweenWhatShrinksComesThrough)
{
  ArrayStream                stream;
  std::vector<double>        noise, waves;
  std::vector<std::uint32_t> runs;
  std::uint64_t              seed = 1;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      seed = seed * 6364136223846793005u + 1442695040888963407u;
      noise.push_back(double(seed >> 11) / 9007199254740992. - 0.5);
      waves.push_back(std::round(1e3 * std::sin(1e-3 * i)));
      runs.push_back(i / 12);
    }
  const std::string of_runs = stream.add(runs, {runs.size()}), of_noise = stream.add(noise, {noise.size()}),
                    of_waves = stream.add(waves, {waves.size()}), again = stream.add(noise, {noise.size()});
  const std::string deflated = stream.deflated(), bytes = inflated(deflated, stream.size());
  for (unsigned int i = 0; i < noise.size(); ++i)
    {
      ASSERT_EQ(runs[i], number_at<std::uint32_t>(bytes, offset_in(of_runs), runs.size(), i));
      ASSERT_EQ(noise[i], number_at<double>(bytes, offset_in(of_noise), noise.size(), i));
      ASSERT_EQ(waves[i], number_at<double>(bytes, offset_in(of_waves), waves.size(), i));
      ASSERT_EQ(noise[i], number_at<double>(bytes, offset_in(again), noise.size(), i));
    }
  // noise is as large as it is but for its sign and exponent; runs and waves are next to nothing
  EXPECT_LT(deflated.size(), 2 * 8 * noise.size());
  EXPECT_LT(deflated.size(), 2 * 7.3 * noise.size() + 40000);
  EXPECT_EQ(ArrayStream().deflated().size(), 8u); // an empty stream is one, too
}



TEST(Report, TextsCannotEndAnElement)
{
  EXPECT_EQ("\"a\\u003c/script>\\\"\\\\\\u000a\"", json_text("a</script>\"\\\n"));
  EXPECT_EQ("null", json_number(std::nan("")));
  EXPECT_EQ("null", json_number(HUGE_VAL));
  EXPECT_EQ(1. / 3, std::stod(json_number(1. / 3)));
}



TEST(Report, TablesAreReadWithUnitsWordsAndWithoutTheLastHalfLine)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/a.csv";
  write(file, "t [s],\"a, \"\"b\"\" [x] [m/s]\",word,gap\n0,1.5,flap,\n1,-2e-3,\"lag, fast\",7\n2,nan,3,8\n3,4");
  const CsvColumns table = CsvColumns::read(file);
  EXPECT_EQ((std::vector<std::string>{"t|s", "a, \"b\" [x]|m/s", "word|", "gap|"}), names_of(table));
  ASSERT_EQ(3u, table.n_rows);
  EXPECT_FALSE(table.columns[1].is_text);
  EXPECT_EQ(-2e-3, table.columns[1].numbers[1]);
  EXPECT_TRUE(std::isnan(table.columns[1].numbers[2]));
  EXPECT_TRUE(table.columns[2].is_text);
  EXPECT_EQ((std::vector<std::string>{"flap", "lag, fast", "3"}), table.columns[2].words);
  EXPECT_TRUE(std::isnan(table.columns[3].numbers[0]));
  EXPECT_EQ(8, table.columns[3].numbers[2]);
  EXPECT_EQ(0u, CsvColumns::read(folder.path + "/none.csv").n_rows);
}



TEST(Report, GrowingTablesAreThoseOfTheWholeFile)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/dynamic.csv";
  const auto          same = [&](const CsvColumns &a) {
    const CsvColumns b = CsvColumns::read(file);
    ASSERT_EQ(names_of(b), names_of(a));
    ASSERT_EQ(b.n_rows, a.n_rows);
    for (unsigned int c = 0; c < b.columns.size(); ++c)
      {
        EXPECT_EQ(b.columns[c].is_text, a.columns[c].is_text);
        EXPECT_EQ(b.columns[c].words, a.columns[c].words);
        for (unsigned int i = 0; i < b.n_rows; ++i)
          EXPECT_TRUE(b.columns[c].numbers[i] == a.columns[c].numbers[i] ||
                      (std::isnan(b.columns[c].numbers[i]) && std::isnan(a.columns[c].numbers[i])));
      }
  };
  GrowingTables tables;
  EXPECT_EQ(0u, tables.read(file).n_rows); // there is none yet
  std::string text = "t [s],x,word\n";
  for (const std::string more :
       {"", "0,1.5,2\n1,nan,3.25\n2,7", "5,4\n3,0.1,flap\n", "4,1e300,\"lag, \"\"fast\"\"\"\n5,,lead\n"})
    {
      text += more;
      write(file, text);
      same(tables.read(file));
    }
  const CsvColumns &table = tables.read(file);
  ASSERT_EQ(6u, table.n_rows);
  EXPECT_EQ(75, table.columns[1].numbers[2]);
  EXPECT_EQ((std::vector<std::string>{"2", "3.25", "4", "flap", "lag, \"fast\"", "lead"}), table.columns[2].words);
  for (unsigned int i = 0; i < 3000; ++i)
    text += std::to_string(6 + i) + "," + std::to_string(std::sin(i)) + ",x\n";
  write(file, text);
  same(tables.read(file));
  // another file of the same name, longer and shorter
  for (const unsigned int n : {5000, 3})
    {
      text = "t [s],y [m],word\n";
      for (unsigned int i = 0; i < n; ++i)
        text += std::to_string(i) + "," + std::to_string(std::cos(i)) + ",3.10\n";
      write(file, text);
      same(tables.read(file));
    }
}



TEST(Report, ThinnedTablesKeepEndsAndPeaksOfAllColumns)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/a.csv";
  const unsigned int  n = 20000, n_columns = 5;
  std::string         text = "t [s],a,b,c,d\n";
  for (unsigned int i = 0; i < n; ++i)
    text += std::to_string(i) + "," + (i == 12345 ? "9" : "0") + "," + (i == 777 ? "-9" : "0.5") + ",1," +
            std::to_string(std::sin(0.01 * i)) + "\n";
  write(file, text);
  const CsvColumns  table = CsvColumns::read(file);
  const std::size_t most  = 5000;
  const auto        rows  = table.kept(most);
  EXPECT_LE(rows.size() * n_columns, most + 2 * n_columns);
  EXPECT_GE(rows.size(), 100u);
  EXPECT_EQ(0u, rows.front());
  EXPECT_EQ(n - 1, rows.back());
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 12345u));
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 777u));
  EXPECT_EQ(n, table.kept(n * n_columns).size());
}



TEST(Report, ThinnedTablesKeepTheirExtremesBesideWhatIsNoNumber)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/dynamic.csv";
  std::string         text = "t [s],x [m]\n";
  for (unsigned int i = 0; i < 20000; ++i)
    text += std::to_string(i) + "," + (i == 12346 ? "9" : i == 778 ? "-9" : i % 3 == 0 ? "nan" : "0.5") + "\n";
  write(file, text);
  const auto rows = CsvColumns::read(file).kept(2000);
  EXPECT_LE(rows.size(), 2500u);
  for (const std::size_t row : {0u, 778u, 12346u, 19999u})
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), row)) << row;
  EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const std::size_t i) { return i % 3 == 0 && i > 0; }));
}



TEST(Report, RotationThroughPlacesThatHold)
{
  const Matrix3 R = cayley(Vector3(0.7, -1.1, 0.4)), bent = cayley(Vector3(0., 0.1, 0.));
  // of three places, whatever the slopes there, and of one triad
  std::vector<Vector3> a = {{1, 0, 0}, {0, 2, 0}, {-1, -2, 0}}, b;
  for (const auto &x : a)
    b.push_back(R * x);
  EXPECT_LT((fitted_rotation(a, b, {R * bent, R * bent, R * bent}, 1e-4) - R).norm(), 1e-6);
  EXPECT_LT((fitted_rotation({Vector3::Zero()}, {Vector3::Zero()}, {R}, 1e-4) - R).norm(), 1e-14);
  // of two places on a line: through these whatever the slopes there, turned about the line as both sections together
  a                 = {{-1, 0, 0}, {1, 0, 0}};
  b                 = {R * a[0], R * a[1]};
  const Matrix3 fit = fitted_rotation(a, b, {R * bent, R * bent}, 1e-4);
  EXPECT_LT((fit * a[1] - b[1]).norm(), 1e-7);
  EXPECT_LT((fit - R).norm(), 1e-6);
}



TEST(Report, PageIsWholeAndHasNoMarksLeft)
{
  const ScratchFolder folder;
  write(folder.path + "/used.prm", "set Title = @DATA@ </script><script>alert(1)</script> @SCRIPT@\n");
  write(folder.path + "/dynamic.csv", "t [s],x [m]\n0,1\n1,2\n");
  write_report({folder.path}, folder.path + "/report.html");
  const std::string page = content_of(folder.path + "/report.html");
  EXPECT_EQ(page.size() - 8, page.rfind("</html>\n"));
  EXPECT_FALSE(contains(page, "<script>alert"));
  EXPECT_TRUE(contains(page, "@DATA@ \\u003c/script>"));
  EXPECT_FALSE(contains(page, "@HEADER@"));
  EXPECT_FALSE(contains(page_script(), "</script"));
  EXPECT_LE(page_script().size(), 120000u);
  std::filesystem::remove(folder.path + "/used.prm");
  std::filesystem::remove(folder.path + "/dynamic.csv");
  EXPECT_THROW(write_report({folder.path}, folder.path + "/report.html"), InputError);
}
