#include "aeolian_twin/nodes/parameters.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using XmlRpc::XmlRpcValue;

const std::vector<ParameterDeclaration> declared{
    {"size", 0.5, "m", "", Limits::positive()},
    {"count", 3, "", "", Limits::between(1, 9)},
    {"on", false, "", ""},
    {"palette", std::string("sand"), "", "", Limits::any(), {"sand", "diverging"}},
    {"horizons", std::vector<double>{60, 120}, "s", "", Limits::positive()},
};

template <class Value>
XmlRpcValue given(const std::string& name, const Value& value) {
  XmlRpcValue values;
  values[name] = value;
  return values;
}

std::string error_of(const XmlRpcValue& values) {
  try {
    Parameters(declared, "/node", values);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, DefaultsHoldWhereNothingIsGiven) {
  const Parameters p(declared, "/node", XmlRpcValue());
  EXPECT_EQ(p.number("size"), 0.5);
  EXPECT_EQ(p.integer("count"), 3);
  EXPECT_FALSE(p.flag("on"));
  EXPECT_EQ(p.text("palette"), "sand");
  EXPECT_EQ(p.numbers("horizons"), (std::vector<double>{60, 120}));
  EXPECT_TRUE(p.unknown().empty());
}

TEST(Parameters, GivenValuesHold) {
  XmlRpcValue values;
  values["size"] = 2;  // YAML writes whole numbers without a point
  values["count"] = 9;
  values["on"] = true;
  values["palette"] = std::string("diverging");
  values["horizons"][0] = 5;
  values["horizons"][1] = 7.5;
  const Parameters p(declared, "/node", values);
  EXPECT_EQ(p.number("size"), 2);
  EXPECT_EQ(p.integer("count"), 9);
  EXPECT_TRUE(p.flag("on"));
  EXPECT_EQ(p.text("palette"), "diverging");
  EXPECT_EQ(p.numbers("horizons"), (std::vector<double>{5, 7.5}));
}

TEST(Parameters, ABadValueIsRefusedInOneLine) {
  EXPECT_EQ(error_of(given("size", -1.5)), "/node/size: -1.5 is not allowed, must be a number above 0 [m]");
  EXPECT_EQ(error_of(given("size", std::nan(""))),
            "/node/size: nan is not allowed, must be a number above 0 [m]");
  EXPECT_EQ(error_of(given("count", 10)),
            "/node/count: 10 is not allowed, must be a whole number from 1 to 9");
  EXPECT_EQ(error_of(given("palette", std::string("grey"))),
            "/node/palette: 'grey' is not allowed, must be one of sand, diverging");
  XmlRpcValue list;
  list["horizons"][0] = 5;
  list["horizons"][1] = 0;
  EXPECT_EQ(error_of(list).find("/node/horizons: {5,0}"), 0U) << error_of(list);
}

TEST(Parameters, AnotherKindIsRefused) {
  EXPECT_EQ(error_of(given("size", std::string("big"))),
            "/node/size: 'big' is not allowed, must be a number above 0 [m]");
  EXPECT_NE(error_of(given("count", 2.5)), "");
  EXPECT_NE(error_of(given("on", 1)), "");
  EXPECT_NE(error_of(given("palette", 1)), "");
  EXPECT_NE(error_of(given("horizons", 60.0)), "");
  XmlRpcValue nested;
  nested["size"]["value"] = 1;
  EXPECT_NE(error_of(nested), "");
  XmlRpcValue words;
  words["horizons"][0] = std::string("soon");
  EXPECT_NE(error_of(words), "");
}

TEST(Parameters, MisspeltNamesAreFound) {
  const Parameters p(declared, "/node", given("sise", 2.0));
  EXPECT_EQ(p.unknown(), std::vector<std::string>{"sise"});
  EXPECT_EQ(p.number("size"), 0.5);
}

}  // namespace
}  // namespace aeolian
