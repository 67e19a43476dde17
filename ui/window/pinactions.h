// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QString>

#include <string>
#include <vector>

namespace ps {

class Document;
class Notices;
class Selection;

/// What is done with pins, which hold a part of their body: put on one, copied, pasted, doubled. Each is one undo step.
class PinActions {
 public:
  PinActions(Document& document, Selection& selection, Notices& notices)
      : m_document(document), m_selection(selection), m_notices(notices) {}
  bool alone() const;  ///< pins are selected, and nothing else is
  void add();
  std::string copied() const;           ///< those that are selected, as text
  bool paste(const std::string& text);  ///< false: the text holds none
  void duplicate();
  QString name() const;      ///< of those that are selected: "a pin of Sheet", "2 pins"
  void selectTheirBodies();  ///< in place of them, which are about to go

 private:
  const Body* target() const;
  void put(const std::vector<Region>& pins, const QString& title);
  Document& m_document;
  Selection& m_selection;
  Notices& m_notices;
};

}  // namespace ps
