!> What the log says of a film's bore and gas at its answer.
module gfb_film_notes
  use gfb_kinds, only: wp
  use gfb_aligned_mesh, only: kinks_inside
  use gfb_bore_profile, only: bore_kinks, bore_peak
  use gfb_film_mesh, only: film_mesh_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: show_film_notes

contains

  !> Tells what the scene's bore means for the mesh.
  subroutine show_film_notes(scene, mesh, log)
    type(scene_type), intent(in) :: scene !! of a bearing
    type(film_mesh_type), intent(in) :: mesh !! of its film
    type(run_log_type), intent(in) :: log !! where lines go

    if (scene%bore%present) call show_bore(scene, mesh, log)
  end subroutine show_film_notes

  !> Height of the bore, and where its kinks lie.
  subroutine show_bore(scene, mesh, log)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: mesh
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words
    integer :: on_pad, inside

    associate (profile => scene%bore%profile)
      words = 'bore             up to '//text(bore_peak(profile)*1.0e6_wp, 4)// &
              ' um over the circle, '//text(bore_peak(profile)/scene%bearing%clearance, 3)// &
              ' of the clearance'
      call kinks_inside(mesh, bore_kinks(profile), on_pad, inside)
    end associate
    if (on_pad > 0 .and. inside == 0) then
      words = words//'; sides of elements on all '//text(on_pad)//' kinks'
    else if (on_pad > 0) then
      words = words//'; '//text(inside)//' of '//text(on_pad)//' kinks lie inside elements: '// &
              'the error that they leave shrinks with the square of an element''s length'
    end if
    call log%line(words)
  end subroutine show_bore
end module gfb_film_notes
