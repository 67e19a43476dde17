// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class QGridLayout;
class QHBoxLayout;
class QToolButton;

namespace ps {

class Actions;
class Session;
class Toolbox;

/// What a hand in the headset holds in the other: the run, what is drawn with which brush, gravity, and the pages that
/// the board can show.
class VrPalette : public QWidget {
  Q_OBJECT
 public:
  /// All must outlive it. `pages`: titles that can be asked for.
  VrPalette(Session& session, Toolbox& tools, const Actions& actions, const std::vector<const char*>& pages);
  void follow();  ///< shows what holds by now
  void showLabelled(bool labelled);

 Q_SIGNALS:
  void pageWanted(const QString& title);
  void labelsWanted(bool shown);  ///< of what the hands hold
  void turnWanted(int steps);     ///< of the wearer, to the right

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  /// A value between two buttons that take the one before and the one after. It leads to its page, where it has one.
  struct Choice {
    QToolButton* value;
    std::function<QString()> text;
  };
  QHBoxLayout* addActions(QGridLayout& grid, const std::vector<std::pair<const char*, const char*>>& row);
  void addTurns(QHBoxLayout& row);
  QToolButton* addChoice(QGridLayout& grid, const QString& name, std::function<QString()> text,
                         const std::function<void(int)>& step, const char* page = nullptr);
  void addPages(QGridLayout& grid, const std::vector<const char*>& pages);
  void stepTemperature(int by);
  QString becomes() const;
  void stepBecomes(int by);
  void stepColour(int by);
  std::string materialId() const;  ///< "" where the scene has none
  QString material() const;
  void showSwatch();
  QString colour() const;

  Session& m_session;
  Toolbox& m_tools;
  const Actions& m_actions;
  std::vector<Choice> m_choices;
  QToolButton *m_material = nullptr, *m_labelled = nullptr;
  /// Of which material the swatch is, after how many changes of the document; nothing: it may look otherwise by now.
  std::optional<std::pair<std::string, uint64_t>> m_swatched;
};

}  // namespace ps
