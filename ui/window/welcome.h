// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/welcome/gallery.h"
#include "ui/welcome/thumbnails.h"

#include <QtCore/QObject>

class QMenu;
class QStackedWidget;
class QWidget;

namespace ps {

class Actions;
class FileActions;
class RestoreOffer;
class Session;
class TopBar;
class Viewport;
class WelcomePage;
class WindowLayout;

/// The welcome page in a window: when it shows, what its buttons do, the menu of samples, and pictures of what is
/// opened and saved. While it shows there are no docks.
class Welcome : public QObject {
  Q_OBJECT
 public:
  /// What of the window it has to do with.
  struct Parts {
    Session& session;
    const Actions& actions;
    FileActions& files;
    RestoreOffer& restore;
    WindowLayout& layout;
    QStackedWidget& centre;
    QWidget& scene;  ///< of `centre`: what shows without it
    TopBar& top;
    Viewport* view;  ///< nullptr where there is no picture
  };
  /// `samples`: their folder; "" for none. Once all actions of the window are there.
  Welcome(const Parts& parts, const QString& samples, QObject* parent = nullptr);
  WelcomePage* page() const { return m_page; }
  bool shown() const;
  void show();
  /// Unless it is the first start ever, which shows the first sample, or somebody prefers it not to.
  void showAtStart();
  void leave();
  void keepPicture() { m_thumbnails.take(); }  ///< of the open project
  Thumbnails& pictures() { return m_thumbnails; }
  void endPictures() { m_thumbnails.end(); }

 private:
  void makePage();
  void connectPage();
  void fillMenu();
  void locate(const QString& path);
  void focusFirst();
  void onPage();
  void showOffer();

  Parts m_parts;
  Gallery m_gallery;
  Thumbnails m_thumbnails;
  WelcomePage* m_page = nullptr;
  bool m_bare = false;      ///< docks are away for the page
  bool m_starting = false;  ///< it shows, and the first project is still to come
};

}  // namespace ps
