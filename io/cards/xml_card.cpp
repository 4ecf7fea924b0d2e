#include "io/cards/xml_card.h"

#include <pugixml.hpp>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

int line_at(const std::string& text, std::ptrdiff_t offset) {
  const auto end = std::min<std::ptrdiff_t>(offset, static_cast<std::ptrdiff_t>(text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + end, '\n'));
}

XmlElement element_of(const pugi::xml_node& node, const std::string& text) {
  XmlElement out{.name = node.name(), .line = line_at(text, node.offset_debug())};
  for (const pugi::xml_attribute& attribute : node.attributes())
    out.attributes.push_back({attribute.name(), attribute.value()});
  for (const pugi::xml_node& part : node.children()) {
    if (part.type() == pugi::node_element) out.children.push_back(element_of(part, text));
    if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) {
      const std::string_view words = trimmed(part.value());
      if (!words.empty()) out.text += (out.text.empty() ? "" : " ") + std::string(words);
    }
  }
  return out;
}

void add_unread(const XmlElement& element, std::vector<std::string>& out) {
  const std::string at = at_line(element.place(), "<" + element.name);
  if (!element.is_read) {
    out.push_back(at + ">");
    return;
  }
  for (const XmlElement::Attribute& attribute : element.attributes) {
    if (!attribute.is_read)
      out.push_back(at + " " + attribute.name + "=\"" + attribute.value + "\">");
  }
  if (!element.children.empty() && !element.text.empty())
    out.push_back(at_line(element.place(), "'" + element.text + "'"));
  for (const XmlElement& child : element.children) add_unread(child, out);
}

}  // namespace

const XmlElement* XmlElement::child(const std::string& wanted) const {
  for (const XmlElement& one : children) {
    if (one.name != wanted) continue;
    one.is_read = true;
    return &one;
  }
  return nullptr;
}

std::string XmlElement::attribute(const std::string& wanted) const {
  for (const Attribute& one : attributes) {
    if (one.name != wanted) continue;
    one.is_read = true;
    return one.value;
  }
  return "";
}

std::optional<double> XmlElement::number(const std::string& wanted) const {
  const XmlElement* found = child(wanted);
  if (found == nullptr) return std::nullopt;
  return card_number(found->text, found->place(), wanted);
}

double XmlElement::required(const std::string& wanted) const {
  const auto value = number(wanted);
  if (!value) throw std::runtime_error("the card has no <" + wanted + ">");
  return *value;
}

XmlElement xml_of(const std::string& text) {
  (void)card_lines(text, "\n");  // refuses lines that no card has
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_fragment);
  if (!result) {
    std::string why = result.description();
    if (result.status == pugi::status_end_element_mismatch)
      why = "an element is closed that is not open, or one is not closed";
    throw std::runtime_error(at_line({line_at(text, result.offset), ""}, why));
  }
  XmlElement root = element_of(document, text);
  root.is_read = true;
  return root;
}

std::vector<const XmlElement*> elements_of(const XmlElement& root, const std::string& name) {
  std::vector<const XmlElement*> out;
  for (const XmlElement& one : root.children) {
    if (one.name == name) out.push_back(&one);
    const auto deeper = elements_of(one, name);
    out.insert(out.end(), deeper.begin(), deeper.end());
  }
  return out;
}

std::vector<std::string> unread_parts(const XmlElement& element) {
  std::vector<std::string> out;
  add_unread(element, out);
  return out;
}

}  // namespace viscard
