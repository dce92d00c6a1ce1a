#include "tunica/bc/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <numbers>

#include "tunica/base/error.hpp"

namespace tunica::bc {

struct Formula::Parser {
  double x = 0, y = 0, z = 0, t = 0;
  mu::Parser expression;

  explicit Parser(const std::string& text) {
    expression.DefineVar("x", &x);
    expression.DefineVar("y", &y);
    expression.DefineVar("z", &z);
    expression.DefineVar("t", &t);
    expression.DefineConst("pi", std::numbers::pi);
    expression.SetExpr(text);
    int values = 0;
    expression.Eval(values);  // finds what is wrong with the text
    if (values != 1)
      throw InputError("formula", fmt::format("`{}` has {} values", text, values), "write one formula without commas");
  }
};

Formula::Formula(const std::string& text) {
  try {
    parser_ = std::make_shared<Parser>(text);
  } catch (const mu::Parser::exception_type& error) {
    throw InputError("formula", fmt::format("`{}` is no formula: {}", text, error.GetMsg()),
                     "write a formula of x, y, z and t with + - * / ^, sin, exp, sqrt, abs, a ? b : c and pi");
  }
}

double Formula::operator()(double x, double y, double z, double t) const {
  parser_->x = x, parser_->y = y, parser_->z = z, parser_->t = t;
  return parser_->expression.Eval();
}

}  // namespace tunica::bc
