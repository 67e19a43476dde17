// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>
#include <QtWidgets/QWidget>

#include <functional>
#include <vector>

class QAction;
class QButtonGroup;
class QLabel;
class QHBoxLayout;
class QLayout;
class QScrollArea;
class QVBoxLayout;

namespace ps {

class CardGrid;
class Gallery;
struct RecentProject;

/// The first page: samples and templates as cards, what was opened lately, unsaved work that can be restored, and ways
/// to the rest of the program. The scene that is open goes on behind it.
class WelcomePage : public QWidget {
  Q_OBJECT
 public:
  /// An entry of the list on the left; without an action it is a heading.
  struct Entry {
    QString icon, text;
    QAction* action = nullptr;
  };
  /// `above`, `below`: entries at the upper and at the lower end. Both must outlive the page.
  WelcomePage(Gallery& gallery, const std::vector<Entry>& above, const std::vector<Entry>& below,
              QWidget* parent = nullptr);
  void setPresent(const QString& title);  ///< the scene that is open
  struct Choice {
    QString text;
    std::function<void()> act;
  };
  /// What can be restored; "" for `title`: nothing.
  void setOffer(const QString& title, const QString& text, const std::vector<Choice>& choices);
  void setAtStart(bool on);  ///< whether it shows when the program starts
  void readRecent();
  CardGrid* samples() const { return m_samples; }
  CardGrid* templates() const { return m_templates; }

 Q_SIGNALS:
  void projectChosen(const QString& path);
  void projectSought(const QString& path);  ///< it is not there any more
  void templateChosen(const QString& path);
  void closeRequested();
  void atStartChanged(bool on);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeList(const std::vector<Entry>& above, const std::vector<Entry>& below);
  QWidget* makeMiddle();
  QWidget* makeSide();
  void showGallery();
  void fitOffer();
  void showRecent(const std::vector<RecentProject>& recent);

  Gallery& m_gallery;
  CardGrid *m_samples, *m_templates;
  QScrollArea* m_scroll = nullptr;
  QLayout* m_chips = nullptr;
  QButtonGroup* m_tags = nullptr;
  QWidget *m_list = nullptr, *m_side = nullptr, *m_offer = nullptr;
  QLabel *m_offerTitle = nullptr, *m_offerText = nullptr, *m_present = nullptr, *m_noRecent = nullptr;
  QHBoxLayout* m_offerButtons = nullptr;
  QVBoxLayout* m_recent = nullptr;
  QWidget* m_atStart = nullptr;
};

}  // namespace ps
