#pragma once

#include "models/maths/interval.h"

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace viscard {

// The keys of a result stand in one place: a function `void show_keys(ResultVisitor& v, const Result& r)`
// beside its struct shows each of them with its value and one phrase of meaning,
//   v("E0_Pa", r.E0_Pa, "instantaneous modulus");
// JSON, the value in Python, the schema and the table of keys come from it.
//
// A value is a number (null unless it is finite), a whole number, a flag, a text, an Interval, a struct
// that has show_keys(), a vector of these, a matrix, or an optional one, whose key
// is missing if it holds nothing. A visitor that describes sees each optional value, and an example of
// each list, made by the default constructor.
class ResultVisitor {
 public:
  virtual ~ResultVisitor() = default;

  template <typename Value>
  void operator()(std::string_view key, const Value& value, const char* what);
  // A text that is one of these words.
  void word(std::string_view key, const std::string& value, const std::vector<const char*>& words,
            const char* what) {
    text(key, value, what, &words);
  }
  // A key that is there always; null if it holds nothing.
  template <typename Value>
  void or_null(std::string_view key, const std::optional<Value>& value, const char* what);
  // body() shows the keys of an object. `is_null`: null in its place.
  template <typename Body>
  void object(std::string_view key, const char* what, const Body& body, bool is_null = false);
  // body(row) shows the keys of the object of each row.
  template <typename Rows, typename Body>
  void list(std::string_view key, const char* what, const Rows& rows, const Body& body);
  // body(row) shows one key, which is no word of viscard's: the name of a result, a reason.
  template <typename Rows, typename Body>
  void map(std::string_view key, const char* what, const Rows& rows, const Body& body);
  // Keys that are there only if the condition holds. body() must bear default values.
  template <typename Body>
  void when(bool condition, const Body& body);

  // Objects as a file of viscard holds them, such as materials, from their JSON; one, or a list.
  virtual void document(std::string_view key, const std::string& json, const char* what) = 0;
  virtual void documents(std::string_view key, const std::vector<std::string>& json,
                         const char* what) = 0;

  // True for values in memory, which also take what is too long for text: curves, matrices.
  virtual bool is_in_memory() const { return false; }

 protected:
  enum class Part { kObject, kList, kMap, kEntry };
  virtual void number(std::string_view key, double value, const char* what) = 0;
  virtual void whole(std::string_view key, std::int64_t value, const char* what) = 0;
  virtual void flag(std::string_view key, bool value, const char* what) = 0;
  // words: the allowed ones; null: any.
  virtual void text(std::string_view key, const std::string& value, const char* what,
                    const std::vector<const char*>* words) = 0;
  virtual void pair(std::string_view key, const Interval& value, const char* what) = 0;
  virtual void numbers(std::string_view key, const std::vector<double>& values,
                       const char* what) = 0;
  virtual void wholes(std::string_view key, const std::vector<std::int64_t>& values,
                      const char* what) = 0;
  virtual void texts(std::string_view key, const std::vector<std::string>& values,
                     const char* what) = 0;
  virtual void flags(std::string_view key, const std::vector<bool>& values, const char* what) = 0;
  virtual void matrix(std::string_view key, const Eigen::MatrixXd& values, const char* what) = 0;
  virtual void null(std::string_view key) = 0;
  // What follows up to close() are keys of the object or map `key`, entries of the list `key`, or (kEntry)
  // keys of the next entry of the list.
  virtual void open(Part part, std::string_view key, const char* what) = 0;
  virtual void close() = 0;
  // Of a visitor that describes: keys follow that are not always there; the next key may be null.
  virtual bool describes() const { return false; }
  virtual void sometimes(bool /*begins*/) {}
  virtual void may_be_null() {}
};

// A number that may not exist: null then.
inline double number_or_null(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

// --- templates: they only choose a function above ----------------------------------------------------

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <typename T>
struct IsVector : std::false_type {};
template <typename T>
struct IsVector<std::vector<T>> : std::true_type {};

template <typename Value>
void ResultVisitor::operator()(std::string_view key, const Value& value, const char* what) {
  if constexpr (std::is_same_v<Value, bool>) {
    flag(key, value, what);
  } else if constexpr (std::is_integral_v<Value>) {
    whole(key, static_cast<std::int64_t>(value), what);
  } else if constexpr (std::is_floating_point_v<Value>) {
    number(key, value, what);
  } else if constexpr (std::is_convertible_v<Value, std::string>) {
    text(key, value, what, nullptr);
  } else if constexpr (std::is_same_v<Value, Interval>) {
    pair(key, value, what);
  } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
    numbers(key, value, what);
  } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
    texts(key, value, what);
  } else if constexpr (std::is_same_v<Value, std::vector<bool>>) {
    flags(key, value, what);
  } else if constexpr (std::is_same_v<Value, Eigen::MatrixXd>) {
    matrix(key, value, what);
  } else if constexpr (IsOptional<Value>::value) {
    when(value.has_value(),
         [&] { (*this)(key, value ? *value : typename Value::value_type{}, what); });
  } else if constexpr (IsVector<Value>::value) {
    if constexpr (std::is_integral_v<typename Value::value_type>) {
      wholes(key, {value.begin(), value.end()}, what);
    } else {
      list(key, what, value, [this](const auto& row) { show_keys(*this, row); });
    }
  } else {
    object(key, what, [&] { show_keys(*this, value); });
  }
}

template <typename Value>
void ResultVisitor::or_null(std::string_view key, const std::optional<Value>& value,
                            const char* what) {
  if (describes()) may_be_null();
  if (value || describes()) {
    (*this)(key, value ? *value : Value{}, what);
  } else {
    null(key);
  }
}

template <typename Body>
void ResultVisitor::object(std::string_view key, const char* what, const Body& body, bool is_null) {
  if (is_null && describes()) may_be_null();
  if (is_null && !describes()) return null(key);
  open(Part::kObject, key, what);
  body();
  close();
}

template <typename Rows, typename Body>
void ResultVisitor::list(std::string_view key, const char* what, const Rows& rows,
                         const Body& body) {
  open(Part::kList, key, what);
  const auto show = [&](const auto& row) {
    open(Part::kEntry, "", what);
    body(row);
    close();
  };
  for (const auto& row : rows) show(row);
  if (describes() && rows.empty()) show(typename Rows::value_type{});
  close();
}

template <typename Rows, typename Body>
void ResultVisitor::map(std::string_view key, const char* what, const Rows& rows,
                        const Body& body) {
  open(Part::kMap, key, what);
  for (const auto& row : rows) body(row);
  if (describes() && rows.empty()) body(typename Rows::value_type{});
  close();
}

template <typename Body>
void ResultVisitor::when(bool condition, const Body& body) {
  if (!condition && !describes()) return;
  sometimes(true);
  body();
  sometimes(false);
}

}  // namespace viscard
