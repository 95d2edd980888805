#include "temporary_folder.h"
#include <samara/base/outline.h>
#include <samara/base/text_file.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <stdexcept>

using namespace samara;

namespace
{
  /** What is said about a file that is refused. */
  std::string
  fault_of(const std::string &name)
  {
    try
      {
        text_of_file(name);
        return "accepted";
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
  }



  TEST(TextFile, IsReadAsItIs)
  {
    const TemporaryFolder folder;
    EXPECT_EQ(text_of_file(folder.write("a", "one\r\ntwo")), "one\r\ntwo");
    EXPECT_EQ(text_of_file(folder.write("b", "")), "");
    EXPECT_EQ(text_of_file(folder.write("c", "one\rtwo\r")), "one\ntwo\n") << "line ends of an old Macintosh";
  }



  TEST(TextFile, WithoutItsByteOrderMark)
  {
    const TemporaryFolder folder;
    EXPECT_EQ(text_of_file(folder.write("a", "\xef\xbb\xbfset x = 1")), "set x = 1");
  }



  TEST(TextFile, NamesOtherEncodings)
  {
    const TemporaryFolder folder;
    const std::string     little("s\0e\0t\0", 6), big("\0s\0e\0t", 6);
    for (const auto &text : {"\xff\xfe" + little, "\xfe\xff" + big, little, big})
      EXPECT_NE(fault_of(folder.write("a", text)).find("UTF-16"), std::string::npos);
    EXPECT_EQ(fault_of(folder.write("a", std::string("one\ntwo\0", 8))),
              folder.path("a") + ":2: there is a zero byte; this is no text file.");
  }



  // Nobody waits for a pipe into which nobody writes, nor for the end of a device that has none.
  TEST(TextFile, RefusesWhatIsNoFile)
  {
    const TemporaryFolder folder;
    const auto            pipe = folder.path("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_NE(fault_of(pipe).find("it is a pipe"), std::string::npos);
    EXPECT_NE(fault_of("/dev/zero").find("it is a device"), std::string::npos);
    EXPECT_NE(fault_of(folder.path(".")).find("it is a folder"), std::string::npos);
    EXPECT_EQ(fault_of(folder.path("none")), "cannot open the file <" + folder.path("none") + ">.");
    EXPECT_NE(fault_of(std::string(5000, 'a')).find("too long"), std::string::npos);
    EXPECT_NE(fault_of("").find("cannot open"), std::string::npos);
  }



  TEST(TextFile, HasALargestSize)
  {
    const TemporaryFolder folder;
    const auto            large = folder.write("large", "");
    std::filesystem::resize_file(large, std::uintmax_t(1) << 40); // which takes no space
    EXPECT_EQ(fault_of(large), "the file <" + large + "> is larger than 256 MiB.");
  }



  // Each file includes the next one twice: a thousand million readings.
  TEST(TextFile, IncludesEnd)
  {
    const TemporaryFolder folder;
    for (unsigned int i = 0; i < 30; ++i)
      {
        const std::string next = "include f" + std::to_string(i + 1) + "\n";
        folder.write("f" + std::to_string(i), next + next);
      }
    folder.write("f30", "\n");
    Complaints complaints;
    Outline::of_file(folder.path("f0"), complaints);
    ASSERT_FALSE(complaints.empty());
    EXPECT_NE(complaints.all()[0].find("there are too many files included in each other"), std::string::npos);
  }
} // namespace
