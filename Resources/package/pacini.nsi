; The installer for Windows, for one user and so without an administrator. cmake/WriteWindowsPackage.cmake defines VERSION,
; FOLDER, which lists the files, and OUTPUT. Silently: pacini-VERSION-windows-setup.exe /S /D=C:\a folder
Target amd64-unicode ; as the programs: a machine may have nothing for 32 bits
Name "Pacini ${VERSION}"
OutFile "${OUTPUT}"
InstallDir "$LOCALAPPDATA\Programs\Pacini"
InstallDirRegKey HKCU "Software\Pacini" "Folder"
RequestExecutionLevel user
SetCompressor /SOLID lzma
SetDateSave off
ShowInstDetails nevershow
ShowUninstDetails nevershow
!define UNINSTALL "Software\Microsoft\Windows\CurrentVersion\Uninstall\Pacini"

Page directory
Page instfiles
UninstPage uninstConfirm
UninstPage instfiles

Section
    !include "${FOLDER}/install.nsh"
    SetOutPath "$INSTDIR"
    WriteUninstaller "$INSTDIR\uninstall.exe"
    ; PATH stays as it is: an installer that writes a long one may cut it.
    CreateDirectory "$SMPROGRAMS\Pacini"
    SetOutPath "$PROFILE"
    CreateShortcut "$SMPROGRAMS\Pacini\Pacini editor.lnk" "$INSTDIR\bin\PaciniEditor.exe"
    CreateShortcut "$SMPROGRAMS\Pacini\Pacini live.lnk" "$INSTDIR\bin\PaciniStandalone.exe"
    CreateShortcut "$SMPROGRAMS\Pacini\Pacini command.lnk" "$SYSDIR\cmd.exe" '/k set "PATH=$INSTDIR\bin;%PATH%" && pacini --help'
    WriteRegStr HKCU "Software\Pacini" "Folder" "$INSTDIR"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayName" "Pacini"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayVersion" "${VERSION}"
    WriteRegStr HKCU "${UNINSTALL}" "Publisher" "The Pacini developers"
    WriteRegStr HKCU "${UNINSTALL}" "InstallLocation" "$INSTDIR"
    WriteRegStr HKCU "${UNINSTALL}" "UninstallString" '"$INSTDIR\uninstall.exe"'
    WriteRegStr HKCU "${UNINSTALL}" "QuietUninstallString" '"$INSTDIR\uninstall.exe" /S'
    WriteRegDWORD HKCU "${UNINSTALL}" "NoModify" 1
    WriteRegDWORD HKCU "${UNINSTALL}" "NoRepair" 1
SectionEnd

Section "Uninstall"
    SetOutPath "$TEMP"
    !include "${FOLDER}/remove.nsh"
    RMDir "$LOCALAPPDATA\Programs" ; where the plugins' folder was, unless other programs are there
    Delete "$INSTDIR\uninstall.exe"
    RMDir "$INSTDIR"
    Delete "$SMPROGRAMS\Pacini\Pacini editor.lnk"
    Delete "$SMPROGRAMS\Pacini\Pacini live.lnk"
    Delete "$SMPROGRAMS\Pacini\Pacini command.lnk"
    RMDir "$SMPROGRAMS\Pacini"
    DeleteRegKey HKCU "${UNINSTALL}"
    DeleteRegKey HKCU "Software\Pacini"
SectionEnd
