#pragma once

#include "io/cards/card_lines.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// An element of an XML card. What readers ask for is marked, so that the rest can be named.
struct XmlElement {
  struct Attribute {
    std::string name, value;
    mutable bool is_read = false;
  };
  std::string name, text;  // text: without blanks around it
  int line = 0;
  std::vector<Attribute> attributes;
  std::vector<XmlElement> children;
  mutable bool is_read = false;

  CardLine place() const { return {line, name}; }
  // The first child of the name, or nothing; marks it.
  const XmlElement* child(const std::string& wanted) const;
  // The value of an attribute, or ""; marks it.
  std::string attribute(const std::string& wanted) const;
  // The number in the first child of the name. Throws std::runtime_error for a text that is none.
  std::optional<double> number(const std::string& wanted) const;
  // Throws "the card has no <E>" if it is not there.
  double required(const std::string& wanted) const;
};

// The top level of a card, whose elements need no common parent. Throws std::runtime_error naming the line.
XmlElement xml_of(const std::string& text);

// All elements of the name, at any depth.
std::vector<const XmlElement*> elements_of(const XmlElement& root, const std::string& name);

// What no reader asked for: "line 7: <density>", with the lines in order.
std::vector<std::string> unread_parts(const XmlElement& element);

}  // namespace viscard
