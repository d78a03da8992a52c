// The text of a scene: comments, duplicate keys, places of syntax errors; and changes from the
// command line.
#include <scene/json.hpp>
#include <scene/settings.hpp>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

namespace json_test {
using namespace hyperlattice;

/// The first fault of a text, as "pointer: expected".
std::string fault(std::string_view text) {
  Json json;
  Faults faults;
  const bool parsed = parse_json(text, json, faults);
  const auto all = faults.all();
  EXPECT_TRUE(parsed || !all.empty());
  return all.empty() ? "" : all[0].pointer + ": " + all[0].expected;
}

Json parse(std::string_view text) {
  Json json;
  Faults faults;
  EXPECT_TRUE(parse_json(text, json, faults));
  EXPECT_TRUE(faults.empty());
  return json;
}

/// A document after the settings, or the message of the first fault.
std::string set(std::string_view text, const std::vector<std::string>& settings) {
  Json json = parse(text);
  Faults faults;
  apply_settings(json, settings, faults);
  return faults.empty() ? json.dump() : InputError(faults.all()).what();
}

TEST(Json, CommentsAndOrderAreKept) {
  const Json json =
      parse("{ // one\n \"b\": [1, 2.5, true, null, \"//\"], /* two */ \"a\": {\"c\": -3}}");
  EXPECT_EQ(json.dump(), R"({"b":[1,2.5,true,null,"//"],"a":{"c":-3}})");
}

TEST(Json, DuplicateKeysAreFoundEverywhere) {
  Json json;
  Faults faults;
  EXPECT_TRUE(parse_json(R"({"a": 1, "a": 2, "list": [{"x/y": 1, "x/y": 2}], "o": {"a": 1}})", json,
                         faults));
  const auto all = faults.all();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].pointer, "/a");
  EXPECT_EQ(all[1].pointer, "/list/0/x~1y");
}

TEST(Json, SyntaxErrorsHaveTheirPlace) {
  const auto begins = [](const std::string& text, const std::string& start) {
    return text.substr(0, start.size()) == start;
  };
  EXPECT_PRED2(begins, fault("{\n  \"a\": 1,\n  \"b\": }\n"),
               "line 3, column 8: valid JSON (syntax error");
  EXPECT_PRED2(begins, fault("{\"a\": 1\n \"b\": 2}"), "line 2, column 2: ");  // a missing comma
  EXPECT_PRED2(begins, fault("{\"a\": 1,}"), "line 1, column 9: ");
  EXPECT_PRED2(begins, fault("{\"a\": \"\xC3\xA9\xC3\xA9\" 1}"),
               "line 1, column 12: ");  // columns count characters
  EXPECT_PRED2(begins, fault("{\"a\": 1"), "line 1, column 8: ");
  EXPECT_PRED2(begins, fault(""), "line 1, column 1: ");
  EXPECT_PRED2(begins, fault("{\"a\": NaN}"), "line 1, column 7: ");
  EXPECT_PRED2(begins, fault("{\"a\": 1e999}"), "line 1, column ");
  EXPECT_PRED2(begins, fault("{} {}"), "line 1, column 4: ");
  EXPECT_PRED2(begins, fault("{\"a\": \"\xFF\"}"), "line 1, column ");
  EXPECT_PRED2(begins, fault("{'a': 1}"), "line 1, column 2: ");
}

TEST(Json, NestingIsLimited) {
  const std::string deep(100'000, '[');
  EXPECT_NE(fault(deep).find("at most 64 levels"), std::string::npos);
}

TEST(Json, LongValuesAreCutInMessages) {
  const std::string text = shown(std::string(99, 'a') + "\xC3\xA9" + std::string(900, 'b'));
  EXPECT_LE(text.size(), 110u);
  EXPECT_TRUE(text.ends_with("..."));
  EXPECT_NO_THROW(Json(text).dump());  // no character was cut in two
}

TEST(Json, NamesThatAreNoUtf8CanBeWritten) {
  const std::string latin = "W\xF6rth";
  EXPECT_EQ(json_text(Json{{"path", latin}}), "{\n  \"path\": \"W\xEF\xBF\xBDrth\"\n}\n");
  EXPECT_EQ(json_text(nlohmann::json{{"path", latin}}), json_text(Json{{"path", latin}}));
}

TEST(Json, Utf8IsKnown) {
  for (const char* const text :
       {"", "plain", "W\xC3\xB6rth", "\xEF\xBF\xBD", "\xF0\x9F\x99\x82", "a\nb\"\\"})
    EXPECT_TRUE(is_utf8(text)) << text;
  for (const char* const text : {"W\xF6rth", "\xC3", "\xED\xA0\x80", "\xC0\x80", "\x80"})
    EXPECT_FALSE(is_utf8(text));
}

TEST(Settings, ReplaceAndAdd) {
  const char* const text = R"({"a": {"b": [1, 2]}, "x/y": 0, "~": 0})";
  EXPECT_EQ(set(text, {"/a/b/0=7"}), R"({"a":{"b":[7,2]},"x/y":0,"~":0})");
  EXPECT_EQ(set(text, {"/a/b/2=3", "/a/b/-=4"}), R"({"a":{"b":[1,2,3,4]},"x/y":0,"~":0})");
  EXPECT_EQ(set(text, {"/a/c=5 mm"}), R"({"a":{"b":[1,2],"c":"5 mm"},"x/y":0,"~":0})");
  EXPECT_EQ(set(text, {"/x~1y=true", "/~0={\"k\": [1]}"}),
            R"({"a":{"b":[1,2]},"x/y":true,"~":{"k":[1]}})");
  EXPECT_EQ(set(text, {"/a=x=y"}), R"({"a":"x=y","x/y":0,"~":0})");
  EXPECT_EQ(set(text, {"/a="}), R"({"a":"","x/y":0,"~":0})");
  EXPECT_EQ(set(text, {"/a=\"3\""}), R"({"a":"3","x/y":0,"~":0})");
}

TEST(Settings, BadPointersAreFaults) {
  const char* const text = R"({"pipeline": [{"spacing": 1}], "title": "t"})";
  EXPECT_EQ(set(text, {"/pipeline/3/spacing=2"}),
            "--set /pipeline/3/spacing: 2: expected an index into /pipeline, which has 1 entry");
  EXPECT_EQ(set(text, {"/pipeline/2=2"}),
            "--set /pipeline/2: 2: expected an index into /pipeline, which has 1 entry");
  EXPECT_EQ(set(text, {"/pipeline/01=2"}),
            "--set /pipeline/01: 2: expected an index into /pipeline, which has 1 entry");
  EXPECT_EQ(set(text, {"/pipelin/0=2"}),
            "--set /pipelin/0: 2: expected an existing parent; the scene has no \"pipelin\", did "
            "you mean \"pipeline\"?");
  EXPECT_EQ(
      set(text, {"/title/x=2"}),
      "--set /title/x: 2: expected an existing parent; /title is \"t\", which has no members");
  const std::string form =
      ": expected /pointer=value with a JSON pointer such as /pipeline/0/spacing=0.001, or "
      "name/option=value with the name or the type of a stage";
  EXPECT_EQ(set(text, {"title=2"}), "--set: \"title=2\"" + form);
  EXPECT_EQ(set(text, {"/title"}), "--set: \"/title\"" + form);
  EXPECT_EQ(set(text, {"=2"}), "--set: \"=2\"" + form);
  EXPECT_EQ(set(text, {"/a~2b=2"}), "--set: \"/a~2b=2\"" + form);
  EXPECT_EQ(set(text, {"/title=\xFF"}), "--set /title: \"\xEF\xBF\xBD\": expected text in UTF-8");
}

TEST(Errors, NearestNameByEdits) {
  const std::vector<std::string> names{"hollow_sphere", "sphere", "spacing", "shape", "I-m", "II"};
  EXPECT_EQ(nearest("spacng", names), "spacing");
  EXPECT_EQ(nearest("sapcing", names), "spacing");
  EXPECT_EQ(nearest("hollow_shpere", names), "hollow_sphere");
  EXPECT_EQ(nearest("Im", names), "I-m");
  EXPECT_EQ(nearest("temperature", names), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("", names), "");
}

TEST(Errors, OneLineAFault) {
  const InputError error({{"/a", "1", "a text"}, {"", "", "an object"}});
  EXPECT_STREQ(error.what(), "/a: 1: expected a text\nscene: expected an object");
  EXPECT_EQ(error.faults().size(), 2u);
}

}  // namespace json_test
