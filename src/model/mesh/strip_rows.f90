!> Rows of strips side by side along the axis, and where they are cut apart.
!>
!> Strips side by side with bumps of their own, as one mesh.
!>
!> All strips have as many bumps, and as many stations: a station is the same place of a bump on
!> every strip, at an x of the strip's own. So what counts stations and rows alone holds for all of
!> them: node sets, substructures, and how ranks share them.
module gfb_strip_rows
  use gfb_kinds, only: wp
  use gfb_quad_mesh, only: quad_mesh_type
  implicit none (type, external)
  private
  public :: strip_rows, cut_rows, strips_of_rows, put_strip, join_kinds

contains

  !> Rows of equal strips side by side, symmetric about z = 0 to the last digit: equal elements on
  !> each, its share of all, none over the cuts; one row in the middle of a cut at z = 0.
  pure function strip_rows(width, axial, half, strips, cut) result(rows)
    real(wp), intent(in) :: width !! whole width, cuts included [m]
    integer, intent(in) :: axial  !! elements over the whole width, about
    logical, intent(in) :: half   !! z >= 0 only
    integer, intent(in) :: strips !! more than one
    real(wp), intent(in) :: cut   !! width of each cut [m]
    real(wp), allocatable :: rows(:)
    real(wp) :: strip !! width of each [m]
    integer :: elements, i, k

    strip = strip_width(width, strips, cut)
    elements = max(1, nint(real(axial, wp)/real(strips, wp)))
    if (modulo(strips, 2) == 1 .and. modulo(axial, 2) == 0) then ! a row lies at z = 0
      elements = 2*max(1, nint(0.5_wp*real(axial, wp)/real(strips, wp)))
    end if
    allocate (rows(0))
    do k = 1, strips
      rows = [rows, (0.5_wp*(strip + cut)*real(2*k - 1 - strips, wp) + &
                     0.5_wp*strip*real(2*i - elements, wp)/real(elements, wp), i=0, elements)]
      if (2*k == strips) rows = [rows, 0.0_wp]
    end do
    if (half) rows = pack(rows, rows >= 0.0_wp)
  end function strip_rows

  !> Which rows of elements are cut away.
  pure function cut_rows(rows, width, strips, cut) result(is_cut)
    real(wp), intent(in) :: rows(:) !! of `strip_rows` [m]
    real(wp), intent(in) :: width   !! whole width, cuts included [m]
    integer, intent(in) :: strips   !! more than one
    real(wp), intent(in) :: cut     !! width of each cut [m]
    logical :: is_cut(size(rows) - 1)
    real(wp) :: strip, middle(size(rows) - 1)

    strip = strip_width(width, strips, cut)
    middle = 0.5_wp*(rows(2:) + rows(:size(rows) - 1))
    is_cut = modulo(middle + 0.5_wp*width, strip + cut) > strip
  end function cut_rows

  !> Strip of each row of nodes, from the smallest z on; one in the middle of a cut has either.
  pure function strips_of_rows(rows, width, strips, cut) result(strip)
    real(wp), intent(in) :: rows(:) !! of `strip_rows` [m]
    real(wp), intent(in) :: width   !! whole width, cuts included [m]
    integer, intent(in) :: strips   !! more than one
    real(wp), intent(in) :: cut     !! width of each cut [m]
    integer :: strip(size(rows))

    strip = 1 + floor((rows + 0.5_wp*(width + cut))/(strip_width(width, strips, cut) + cut))
    strip = min(max(strip, 1), strips)
  end function strips_of_rows

  !> Width of one of equal strips [m].
  pure function strip_width(width, strips, cut) result(strip)
    real(wp), intent(in) :: width, cut !! of all, of each cut [m]
    integer, intent(in) :: strips
    real(wp) :: strip
    strip = (width - real(strips - 1, wp)*cut)/real(strips, wp)
  end function strip_width

  !> Gives the rows of a strip the shape that they have on another mesh of as many stations.
  pure subroutine put_strip(mesh, other, strip)
    type(quad_mesh_type), intent(inout) :: mesh !! of all strips, with `row_strip`
    type(quad_mesh_type), intent(in) :: other !! the same stretch, as if all rows were the strip's
    integer, intent(in) :: strip !! its number
    integer :: node, element, row

    do node = lbound(mesh%position, 2), ubound(mesh%position, 2)
      if (mesh%row_strip(modulo(node - 1, mesh%rows) + 1) /= strip) cycle
      mesh%position(:, node) = other%position(:, node)
      mesh%axis_1(:, node) = other%axis_1(:, node)
      mesh%axis_2(:, node) = other%axis_2(:, node)
      mesh%face(:, node) = other%face(:, node)
    end do
    do element = lbound(mesh%element_nodes, 2), ubound(mesh%element_nodes, 2)
      row = modulo(element - 1, mesh%rows - 1) + 1 ! over a cut nothing asks for it
      if (mesh%row_strip(row) == strip) mesh%director(:, :, element) = other%director(:, :, element)
    end do
  end subroutine put_strip

  !> Tells pieces apart that differ on one more strip.
  pure subroutine join_kinds(kind, other)
    integer, intent(inout) :: kind(:) !! of the pieces, numbered in order of their first
    integer, intent(in) :: other(:)   !! their kinds on the other strip
    integer :: joined(size(kind)), i, k, kinds

    kinds = 0
    do i = 1, size(kind)
      do k = 1, i - 1
        if (kind(k) == kind(i) .and. other(k) == other(i)) exit
      end do
      if (k < i) then
        joined(i) = joined(k)
      else
        kinds = kinds + 1
        joined(i) = kinds
      end if
    end do
    kind = joined
  end subroutine join_kinds
end module gfb_strip_rows
