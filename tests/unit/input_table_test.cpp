// Tables as spreadsheets and programs write them.
#include <base/csv.hpp>

#include <hyperlattice/tables.hpp>

#include <gtest/gtest.h>
#include <support/output.hpp>

namespace {
using namespace hyperlattice;

class InputTables : public testing::Test {
 protected:
  NumberTable read(const std::string& text) {
    static constexpr std::string_view names[] = {"x", "y"}, more[] = {"volume"};
    std::ofstream(folder_.file("table.csv"), std::ios::binary) << text;
    return {folder_.file("table.csv"), names, more};
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      const std::string whole = error.what();
      return whole.substr(whole.find(", line ") + 2);
    }
    return "";
  }

  test::Folder folder_{"input_tables"};
};

TEST_F(InputTables, AllTheseSayTheSame) {
  for (const char* same :
       {"x,y\n1,-2\n3,4\n", "\xEF\xBB\xBFx,y\r\n1,-2\r\n3,4\r\n", "x;y\n1;-2\n3;4", "x\ty\n1\t-2\n3\t4\n", "\"x\",\"y\"\n\"1\",-2\n3,\"4\"\n",
        "X, Y\n +1.0e0 , -2\n\n   \n3,4\n", "# x,y\n1,-2\n# between\n3,4\n", "x y\n1   -2\n  3 4  \n", "\n\n name,y,x\na,-2,1\n\"b, c\",4,3\n",
        "X,Y,x,y\n9,9,1,-2\n9,9,3,4\n", "x\ty\tz\n1\t-2\t\n3\t4\t\n", "# made by CT\nx,y\n1,-2\n3,4\n",
        "\xEF\xBB\xBF# made by CT; x in mm\n\n  # y too\nx;y\n1;-2\n3;4\n", "# made by CT\n# y x\n# 2 rows\n-2 1\n4 3\n",
        "\xEF\xBB\xBF\n# x,y\n1,-2\n3,4\n", "# x,y\n# y\nx,y\n1,-2\n3,4\n"}) {
    const NumberTable table = read(same);
    EXPECT_EQ(table["x"], (std::vector<double>{1, 3})) << same;
    EXPECT_EQ(table["y"], (std::vector<double>{-2, 4})) << same;
    EXPECT_TRUE(table["volume"].empty());
  }
  EXPECT_EQ(read("\tx\ty\n\t1\t2\n")["y"], std::vector<double>{2});
}

TEST_F(InputTables, RefusalsShowWhatWasFound) {
  EXPECT_EQ(refusal("a,b\n1,2\n"), "line 1: expected a column \"x\", named in the first line; it names \"a\", \"b\"");
  EXPECT_EQ(refusal("1;2\n"), "line 1: expected a column \"x\", named in the first line; it names \"1\", \"2\"");
  EXPECT_EQ(refusal(""), "line 1: expected a column \"x\", named in the first line; it names \"\"");
  EXPECT_EQ(refusal("# by CT\n\na,b\n1,2\n"), "line 3: expected a column \"x\", named in the first line; it names \"a\", \"b\"");
  EXPECT_EQ(refusal("# x,z\n\n"), "line 1: expected a column \"y\", named in the first line; it names \"x\", \"z\"");
  EXPECT_EQ(refusal("# made by CT\nx,y\n1,2\n3,one\n"), "line 4: expected a number in column \"y\", not \"one\"");
  EXPECT_EQ(refusal("x;y\n1;0,5\n"), "line 2: expected a number in column \"y\", not \"0,5\"; numbers have a decimal point");
  EXPECT_EQ(refusal("x,y\n\n1,2\n3\n"), "line 4: expected a number in column \"y\", not \"\"");
  for (const char* number : {"nan", "inf", "+-1", "++1", "1e999", "0x1", "1 2", "one", "1,"})
    EXPECT_NE(refusal(std::string("x;y\n1;") + number + "\n"), "") << number;
  EXPECT_LT(refusal("x,y\n1," + std::string(1'000'000, '7') + "x\n").size(), 200u);
  EXPECT_LT(refusal(std::string(1'000'000, 'q') + "\n").size(), 400u);
}

TEST_F(InputTables, WhatCannotBeReadToItsEndIsRefused) {
  static constexpr std::string_view names[] = {"x"};
  try {
    const NumberTable table(folder_.path(), names);  // a folder opens, and every read of it fails
    FAIL() << "read a folder";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()), "file " + folder_.path() + " cannot be read to its end");
  }
}

TEST(CsvTables, CommentsAreSkippedUnlessTheyNameTheColumns) {
  const std::vector<std::string> columns{"t", "u"};
  const std::vector<std::vector<std::string>> rows{{"0", "1.5"}, {"2", "-3"}};
  for (const char* same : {"# made by CT\nt,u\n0,1.5\n2,-3\n", "\xEF\xBB\xBF# made by CT, in mm\n\nt;u\n0;1.5\n# between\n2;-3",
                           "# t,u\n0,1.5\n2,-3\n", "# made by CT today\n# t u\n# in mm and such\n0 1.5\n2 -3\n", "# t,u\nt,u\n0,1.5\n2,-3\n"}) {
    const CsvTable table = parse_csv(same);
    EXPECT_EQ(table.columns, columns) << same;
    EXPECT_EQ(table.rows, rows) << same;
  }
  EXPECT_EQ(parse_csv("# t,u\n0,1,\n").columns, columns);
  EXPECT_TRUE(parse_csv("# t,u\n").columns.empty());
  EXPECT_EQ(parse_csv("0,1.5\n2,-3\n").columns, (std::vector<std::string>{"0", "1.5"}));
}

TEST(CsvTables, AreReadTheSameWay) {
  const CsvTable table = parse_csv("\xEF\xBB\xBFLabel;Error;seconds\n\n\"a \"\"b\"\"; c\";0.5;+2\n d ;1;2;3\ne\n");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"Label", "Error", "seconds"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"a \"b\"; c", "0.5", "+2"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"d", "1", "2"}));
  EXPECT_EQ(table.rows[2], (std::vector<std::string>{"e", "", ""}));
  EXPECT_EQ(table.column("error"), 1u);
  EXPECT_EQ(table.column("none"), std::nullopt);
  EXPECT_EQ(csv_number("+2"), 2);
}

}  // namespace
