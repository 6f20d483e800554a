!> Meshes that split all elements of the one before, in words, and the order with which they
!> converge.
module gfb_nested_meshes
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_model_case, only: film_order_bilinear, film_order_biquadratic, film_scheme_auto, &
                            film_scheme_galerkin, film_scheme_supg
  use gfb_scene, only: scene_type
  use gfb_bearing_case, only: pad_length
  use gfb_mesh_case, only: mesh_case_type
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_plan, only: plan_bearing
  implicit none (type, external)
  private
  public :: nested_mesh, mesh_words, formal_order, keep_scheme

  integer, parameter :: quarter = 4             !! the first mesh is coarser by it in each direction
  integer, parameter :: least_circumferential = 4

contains

  !> Elements of a nested mesh. Number 0 is a quarter of what `&mesh` says, or the coarsest mesh
  !> that a case may have.
  pure function nested_mesh(scene, number) result(mesh)
    type(scene_type), intent(in) :: scene !! on the mesh of its case
    integer, intent(in) :: number !! from 0
    type(mesh_case_type) :: mesh

    mesh = scene%mesh
    mesh%circumferential_elements = first_circumferential(scene)*2**number
    mesh%axial_elements = even_quarter(mesh%axial_elements)*2**number
    mesh%arc_elements = even_quarter(mesh%arc_elements)*2**number
    mesh%flat_elements = max(1, nint(real(mesh%flat_elements, wp)/quarter))*2**number
  end function nested_mesh

  !> Elements along the pad of the first mesh; whole ones a pitch where nodes lie above the
  !> crests, so that doubled numbers divide every pitch by two.
  pure integer function first_circumferential(scene) result(elements)
    type(scene_type), intent(in) :: scene
    real(wp) :: pitches

    elements = max(least_circumferential, &
                   nint(real(scene%mesh%circumferential_elements, wp)/quarter))
    if (.not. (scene%model%foil%has_bumps .and. scene%mesh%align_crests)) return
    pitches = pad_length(scene%bearing)/scene%bump_foil%pitch%value
    elements = max(least_circumferential, nint(pitches*max(1, nint(elements/pitches))))
  end function first_circumferential

  !> A quarter of a number, as an even one.
  elemental integer function even_quarter(number) result(even)
    integer, intent(in) :: number
    even = 2*max(1, nint(real(number, wp)/(2*quarter)))
  end function even_quarter

  !> A mesh in words: elements along the pad and over the width, or of a bump.
  pure function mesh_words(scene) result(words)
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words

    associate (mesh => scene%mesh)
      words = text(mesh%circumferential_elements)//' x '//text(mesh%axial_elements)
      if (scene%general%analysis%has_film .and. .not. scene%model%foil%has_bumps) return
      words = words//', '//text(mesh%arc_elements)//'+'//text(mesh%flat_elements)
      if (scene%general%analysis%has_film) return
      words = text(mesh%arc_elements)//'+'//text(mesh%flat_elements)//' x '// &
              text(mesh%axial_elements)
    end associate
  end function mesh_words

  !> Order with which the elements of a scene converge.
  pure function formal_order(scene) result(order)
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp) :: order !! [1]

    order = 2.0_wp
    associate (model => scene%model)
      if (model%film_order == film_order_biquadratic .and. &
          .not. model%foil%has_top_foil) order = 3.0_wp
    end associate
  end function formal_order

  !> Takes for all meshes the film's weighting that the mesh of the case would have: values of two
  !> schemes approach their limit differently.
  subroutine keep_scheme(scene)
    type(scene_type), intent(inout) :: scene !! of a bearing, on the mesh of the case
    type(bearing_plan_type) :: plan
    type(run_log_type) :: quiet

    if (scene%model%film_scheme /= film_scheme_auto .or. &
        scene%model%film_order /= film_order_bilinear) return
    quiet%active = .false.
    call plan_bearing(scene, quiet, plan)
    scene%model%film_scheme = merge(film_scheme_supg, film_scheme_galerkin, plan%upwind)
  end subroutine keep_scheme
end module gfb_nested_meshes
