// Tables as spreadsheets and programs write them.
#include <base/csv.hpp>

#include <hyperlattice/tables.hpp>

#include <gtest/gtest.h>
#include <support/output.hpp>

namespace input_table_test {
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
  for (const char* same : {"x,y\n1,-2\n3,4\n", "\xEF\xBB\xBFx,y\r\n1,-2\r\n3,4\r\n",
                           "x;y\n1;-2\n3;4", "x\ty\n1\t-2\n3\t4\n",
                           "\"x\",\"y\"\n\"1\",-2\n3,\"4\"\n", "X, Y\n +1.0e0 , -2\n\n   \n3,4\n",
                           "# x,y\n1,-2\n# between\n3,4\n", "x y\n1   -2\n  3 4  \n",
                           "\n\n name,y,x\na,-2,1\n\"b, c\",4,3\n", "X,Y,x,y\n9,9,1,-2\n9,9,3,4\n",
                           "x\ty\tz\n1\t-2\t\n3\t4\t\n", "# made by CT\nx,y\n1,-2\n3,4\n",
                           "\xEF\xBB\xBF# made by CT; x in mm\n\n  # y too\nx;y\n1;-2\n3;4\n",
                           "# made by CT\n# y x\n# 2 rows\n-2 1\n4 3\n",
                           "\xEF\xBB\xBF\n# x,y\n1,-2\n3,4\n", "# x,y\n# y\nx,y\n1,-2\n3,4\n"}) {
    const NumberTable table = read(same);
    EXPECT_EQ(table["x"], (std::vector<double>{1, 3})) << same;
    EXPECT_EQ(table["y"], (std::vector<double>{-2, 4})) << same;
    EXPECT_TRUE(table["volume"].empty());
  }
  EXPECT_EQ(read("\tx\ty\n\t1\t2\n")["y"], std::vector<double>{2});
}

TEST_F(InputTables, RefusalsShowWhatWasFound) {
  EXPECT_EQ(refusal("a,b\n1,2\n"),
            "line 1: expected a column \"x\", named in the first line; it names \"a\", \"b\"");
  EXPECT_EQ(refusal("1;2\n"),
            "line 1: expected a column \"x\", named in the first line; it names \"1\", \"2\"");
  EXPECT_EQ(refusal(""), "line 1: expected a table: the file is empty");
  EXPECT_EQ(refusal("# by CT\n\na,b\n1,2\n"),
            "line 3: expected a column \"x\", named in the first line; it names \"a\", \"b\"");
  EXPECT_EQ(refusal("# x,z\n\n"),
            "line 1: expected a column \"y\", named in the first line; it names \"x\", \"z\"");
  EXPECT_EQ(refusal("# made by CT\nx,y\n1,2\n3,one\n"),
            "line 4: expected a number in column \"y\", not \"one\"");
  EXPECT_EQ(refusal("x;y\n1;0,5\n"),
            "line 2: expected a number in column \"y\", not \"0,5\"; numbers have a decimal point");
  EXPECT_EQ(refusal("x,y\n\n1,2\n3\n"), "line 4: expected a number in column \"y\", not \"\"");
  for (const char* number : {"nan", "inf", "+-1", "++1", "1e999", "0x1", "1 2", "one", "1,"})
    EXPECT_NE(refusal(std::string("x;y\n1;") + number + "\n"), "") << number;
  EXPECT_LT(refusal("x,y\n1," + std::string(1'000'000, '7') + "x\n").size(), 200u);
  EXPECT_LT(refusal(std::string(1'000'000, 'q') + "\n").size(), 400u);
}

TEST_F(InputTables, RowsHaveNoMoreCellsThanColumns) {
  EXPECT_EQ(refusal("x,y\n1,5,2,5\n"),
            "line 2: expected a row of at most 2 cells, one a column, not of 4 (decimal commas? "
            "numbers have a decimal point)");
  EXPECT_EQ(refusal("x;y\n1;2\n1;2;3\n"),
            "line 3: expected a row of at most 2 cells, one a column, not of 3");
  EXPECT_EQ(refusal("x y\n1 2 3\n"),
            "line 2: expected a row of at most 2 cells, one a column, not of 3");
  for (const char* trailing :
       {"x,y\n1,2,\n", "x,y,\n1,2,\n", "x;y\n1;2;;\n", "x\ty\n1\t2\t\n", "x y \n1 2 \n"})
    EXPECT_EQ(refusal(trailing), "") << trailing;
}

TEST_F(InputTables, SeveralBadRowsAreToldTogether) {
  EXPECT_EQ(refusal("x;y\n1;a\n1;2\n1;2;3\n"),
            "line 2: expected a number in column \"y\", not \"a\"; line 4: expected a row of at "
            "most 2 cells, one a column, not of 3");
  std::string many = "x;y\n";
  for (int n = 0; n < 9; ++n) many += "1;b\n";
  const std::string all = refusal(many);
  EXPECT_NE(all.find("line 6: "), std::string::npos) << all;
  EXPECT_EQ(all.find("line 7: "), std::string::npos) << all;
  EXPECT_TRUE(all.ends_with("; and 4 such lines more")) << all;
}

TEST_F(InputTables, AColumnIsNamedOnce) {
  EXPECT_EQ(refusal("x,y,x\n1,2,3\n"),
            "line 1: expected one column \"x\", not several; it names \"x\", \"y\", \"x\"");
  EXPECT_EQ(refusal("X,y,X\n1,2,3\n"),
            "line 1: expected one column \"x\", not several; it names \"X\", \"y\", \"X\"");
  EXPECT_EQ(refusal("x,y,Volume,VOLUME\n1,2,3,4\n"),
            "line 1: expected one column \"volume\", not several; it names \"x\", \"y\", "
            "\"Volume\", \"VOLUME\"");
  EXPECT_EQ(refusal("x,y,id,id\n1,2,3,4\n"), "");  // no component reads this column
}

TEST_F(InputTables, AColumnThatIsNearlyCalledAsOneThatMayBeMissingIsRefused) {
  for (const char* name :
       {"volum", "Volumes", "VOLMUE", "vol", "wolume", "volume [mm3]", "volume(mm3)"})
    EXPECT_EQ(refusal(std::string("x,y,") + name + "\n1,2,3\n"),
              std::string("line 1: expected the name \"volume\" for column \"") + name +
                  "\", or one that is less like it");
  EXPECT_EQ(
      refusal("# by CT\nx y volum\n1 2 3\n"),
      "line 2: expected the name \"volume\" for column \"volum\", or one that is less like it");
  for (const char* name :
       {"vo", "value", "column", "id", "x2", "volume,volum", "mass_and_volume", "\"\""})
    EXPECT_EQ(refusal(std::string("x,y,") + name + "\n1,2,3,4\n").find("less like it"),
              std::string::npos)
        << name;
  EXPECT_TRUE(is_nearly_column("Stifnes", "stiffness"));
  EXPECT_FALSE(is_nearly_column("slimness", "stiffness"));
}

TEST_F(InputTables, RowsKnowTheirLines) {
  const NumberTable table = read("# by CT\n\nx,y\n1,2\n# between\n\n3,4\n");
  EXPECT_EQ(table.line(0), 4u);
  EXPECT_EQ(table.line(1), 7u);
  try {
    table.refuse(1, "less");
    FAIL() << "it was not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "file " + folder_.file("table.csv") + ", line 7: expected less");
  }
  // The line above is a comment with the names of the columns.
  EXPECT_EQ(read("# x,y\n1,2\n").line(0), 2u);
}

TEST_F(InputTables, LinesEndWithLineFeedOrCarriageReturn) {
  const NumberTable table = read("x,y\r1,-2\r\r3,4\r");
  EXPECT_EQ(table["x"], (std::vector<double>{1, 3}));
  EXPECT_EQ(table["y"], (std::vector<double>{-2, 4}));
  EXPECT_EQ(refusal("x,y\r1,-2\r3,a"), "line 3: expected a number in column \"y\", not \"a\"");
}

TEST_F(InputTables, BytesThatAreNoTextAreShown) {
  EXPECT_EQ(refusal(std::string("x,y\n1,2\n1,\0\0\n", 13)),
            "line 3: expected a number in column \"y\", not \"U+0000U+0000\"");
  EXPECT_EQ(
      refusal(std::string("x,\0y\n1,2\n", 9)),
      "line 1: expected a column \"y\", named in the first line; it names \"x\", \"U+0000y\"");
  for (const std::string& utf16 :
       {std::string("\xFF\xFEx\0,\0y\0\n\0", 10), std::string("\xFE\xFF\0x\0,\0y\0\n", 10)}) {
    try {
      read(utf16);
      FAIL() << "read UTF-16";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()),
                "file " + folder_.file("table.csv") +
                    " cannot be read: it is a text in UTF-16: save it in ASCII or UTF-8");
    }
  }
}

TEST_F(InputTables, WhatCannotBeReadToItsEndIsRefused) {
  static constexpr std::string_view names[] = {"x"};
  try {
    const NumberTable table(folder_.path(), names);  // a folder can be opened but not read
    FAIL() << "read a folder";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()), "file " + folder_.path() + " cannot be read to its end");
  }
}

TEST(CsvTables, CommentsAreSkippedUnlessTheyNameTheColumns) {
  const std::vector<std::string> columns{"t", "u"};
  const std::vector<std::vector<std::string>> rows{{"0", "1.5"}, {"2", "-3"}};
  for (const char* same :
       {"# made by CT\nt,u\n0,1.5\n2,-3\n",
        "\xEF\xBB\xBF# made by CT, in mm\n\nt;u\n0;1.5\n# between\n2;-3", "# t,u\n0,1.5\n2,-3\n",
        "# made by CT today\n# t u\n# in mm and such\n0 1.5\n2 -3\n",
        "# t,u\nt,u\n0,1.5\n2,-3\n"}) {
    const CsvTable table = parse_csv(same);
    EXPECT_EQ(table.columns, columns) << same;
    EXPECT_EQ(table.rows, rows) << same;
  }
  EXPECT_EQ(parse_csv("# t,u\n0,1,\n").columns, columns);
  EXPECT_TRUE(parse_csv("# t,u\n").columns.empty());
  EXPECT_EQ(parse_csv("0,1.5\n2,-3\n").columns, (std::vector<std::string>{"0", "1.5"}));
}

TEST(CsvTables, AreReadTheSameWay) {
  const CsvTable table =
      parse_csv("\xEF\xBB\xBFLabel;Error;seconds\n\n\"a \"\"b\"\"; c\";0.5;+2\n d ;1;2;3\ne\n");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"Label", "Error", "seconds"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"a \"b\"; c", "0.5", "+2"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"d", "1", "2"}));
  EXPECT_EQ(table.rows[2], (std::vector<std::string>{"e", "", ""}));
  EXPECT_EQ(table.column("error"), 1u);
  EXPECT_EQ(table.column("none"), std::nullopt);
  EXPECT_EQ(csv_number("+2"), 2);
}

TEST(CsvTables, TellRowsOfOtherLengthsAndNamesOfSeveral) {
  const CsvTable table = parse_csv("# by hand\r\nt,u,\r\n0,1\r\n\r\n0,5,1\r\n7\r\n0,1,,\r\n");
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{3, 5, 6, 7}));
  ASSERT_EQ(table.faults.size(), 2u);  // a column without a name does not count
  EXPECT_EQ(table.faults[0].line, 5u);
  EXPECT_NE(table.faults[0].expected.find("at most 2 cells, one a column, not of 3"),
            std::string::npos);
  EXPECT_EQ(table.faults[1].line, 6u);
  EXPECT_EQ(table.faults[1].expected, "a row of 2 cells, not of 1");
  const CsvTable decimal_commas = parse_csv("t,u\r0,5,1,5\r");
  ASSERT_EQ(decimal_commas.faults.size(), 1u);
  EXPECT_EQ(decimal_commas.faults[0].line, 2u);
  EXPECT_NE(decimal_commas.faults[0].expected.find("not of 4 (decimal commas?"), std::string::npos);
  EXPECT_EQ(name_of_several(table), std::nullopt);
  EXPECT_EQ(name_of_several(parse_csv("t,u,,,U\n")), std::nullopt);
  EXPECT_EQ(name_of_several(parse_csv("t,u,u\n")), "u");
}

}  // namespace input_table_test
