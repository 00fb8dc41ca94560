// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model/expression.h"

#include <muParser.h>
#include <numbers>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

struct Expression::Impl {
  double time_s = 0;
  mu::Parser parser;
};

Expression::Expression(const std::string& text) : impl_(std::make_shared<Impl>()) {
  try {
    impl_->parser.DefineConst("pi", std::numbers::pi);
    impl_->parser.DefineConst("gn", kStandardGravity_m_s2);
    impl_->parser.DefineVar("t", &impl_->time_s);
    impl_->parser.SetExpr(text);
    impl_->parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw InputError("\"" + text + "\" cannot be read: " + error.GetMsg());
  }
}

double Expression::operator()(double time_s) const {
  impl_->time_s = time_s;
  return impl_->parser.Eval();
}

}  // namespace flexneck::pipeline
